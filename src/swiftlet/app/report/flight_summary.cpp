// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/flight_summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "swiftlet/app/visible_text.hpp"

namespace swiftlet::app {

std::string flight_text(const FlightReport& r) {
  std::string text = fmt::format(
      "{} after {:.1f} s and {:.1f} m (mean {:.2f} m/s, at most {:.2f})\n"
      "  clearance  {:.3f} m at the least; {}\n"
      "  map        {:.1f} m3 known{}; {} frames, {} refused",
      name_of(r.end), r.time_s, r.length_m, r.mean_speed_mps, r.top_speed_mps, r.least_clearance_m,
      r.end == FlightEnd::kCollided ? "1 collision" : "no collision", r.known_m3,
      r.known_share > 0.0 ? fmt::format(", {:.1f} % of what is within reach", 100.0 * r.known_share)
                          : "",
      r.frames, r.frames_refused);
  if (r.frames_dropped > 0) text += fmt::format(", {} dropped", r.frames_dropped);
  text += fmt::format(
      "\n  planner    {} paths, {} not found; {:.1f} % of the time without one; {} times a new "
      "frame blocked it\n"
      "  time       {:.1f} ms a frame (at most {:.1f}), {} too late; {:.1f} ms a path (at most "
      "{:.1f}), {} too late\n"
      "  digest     {:016x}",
      r.plans, r.plans_failed, 100.0 * r.waiting_share, r.blocked, r.frame_ms, r.frame_ms_max,
      r.deadline_misses, r.plan_ms, r.plan_ms_max, r.late_plans, r.digest);
  return text;
}

std::string flight_json(const FlightReport& r) {
  return json_text({{"end", name_of(r.end)},
                    {"collisions", r.end == FlightEnd::kCollided ? 1 : 0},
                    {"time_s", r.time_s},
                    {"length_m", r.length_m},
                    {"mean_speed_mps", r.mean_speed_mps},
                    {"top_speed_mps", r.top_speed_mps},
                    {"least_clearance_m", r.least_clearance_m},
                    {"goal_distance_m", r.goal_distance_m},
                    {"known_m3", r.known_m3},
                    {"known_share", r.known_share},
                    {"waiting_share", r.waiting_share},
                    {"plans", r.plans},
                    {"plans_failed", r.plans_failed},
                    {"blocked", r.blocked},
                    {"frames", r.frames},
                    {"frames_refused", r.frames_refused},
                    {"frames_dropped", r.frames_dropped},
                    {"deadline_misses", r.deadline_misses},
                    {"late_plans", r.late_plans},
                    {"frame_ms", r.frame_ms},
                    {"frame_ms_max", r.frame_ms_max},
                    {"plan_ms", r.plan_ms},
                    {"plan_ms_max", r.plan_ms_max},
                    {"digest", fmt::format("{:016x}", r.digest)}});
}

std::string track_csv(const FlightReport& report) {
  std::string csv = "x_m,y_m,z_m\n";
  for (const Eigen::Vector3d& p : report.track)
    csv += fmt::format("{:.4f},{:.4f},{:.4f}\n", p.x(), p.y(), p.z());
  return csv;
}

}  // namespace swiftlet::app
