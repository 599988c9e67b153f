// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "swiftlet/app/visible_text.hpp"

namespace swiftlet::app {
namespace {

double milliseconds(Nanoseconds t) { return static_cast<double>(t.count()) * 1e-6; }

double rate(std::size_t frames, double elapsed_s) {
  return elapsed_s > 0.0 ? static_cast<double>(frames) / elapsed_s : 0.0;
}

std::string latency_text(const Latency& latency) {
  std::string text = fmt::format("  latency    p50 {:.2f} ms, p99 {:.2f} ms\n",
                                 milliseconds(latency.frame_percentile(0.50)),
                                 milliseconds(latency.frame_percentile(0.99)));
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    text += fmt::format("    {:<9}  p50 {:.2f} ms, p99 {:.2f} ms\n", kStageNames[i],
                        milliseconds(latency.stage_percentile(stage, 0.50)),
                        milliseconds(latency.stage_percentile(stage, 0.99)));
  }
  if (latency.has_ages()) {
    text += fmt::format("  age        p50 {:.2f} ms, p99 {:.2f} ms from the camera to the map\n",
                        milliseconds(latency.age_percentile(0.50)),
                        milliseconds(latency.age_percentile(0.99)));
  }
  return text;
}

/// "12 not_finite, 3 low_confidence"
std::string reasons_text(const FrameTally& tally) {
  std::string reasons;
  for (std::size_t i = 0; i < kPoseRefusalNames.size(); ++i) {
    if (tally.poses_refused_by[i] == 0) continue;
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", tally.poses_refused_by[i],
                           kPoseRefusalNames[i]);
  }
  return reasons;
}

std::string poses_text(const FrameTally& tally, std::size_t restarts) {
  std::string text;
  if (tally.poses_refused > 0)
    text += fmt::format("  poses      {} refused ({})\n", tally.poses_refused, reasons_text(tally));
  if (tally.pose_jumps > 0) {
    text += fmt::format("  jumps      {} of the pose source; a new map began {} times\n",
                        tally.pose_jumps, restarts);
  }
  if (tally.stale_alarms > 0)
    text += fmt::format("  alarm      the tracker fell silent {} times\n", tally.stale_alarms);
  return text;
}

/// "2 unplugged, 2 restarted"
std::string events_text(const RigEventCounts& events) {
  std::string text;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", events[i], kRigEventNames[i]);
  }
  return text.empty() ? text : fmt::format("  devices    {}\n", text);
}

nlohmann::ordered_json events_json(const RigEventCounts& events) {
  auto json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i] > 0) json[std::string(kRigEventNames[i])] = events[i];
  }
  return json;
}

nlohmann::ordered_json clock_json(const ClockSteps& steps) {
  return {{"back", steps.back},
          {"last_back_s", seconds(steps.last_back)},
          {"ahead", steps.ahead},
          {"last_ahead_s", seconds(steps.last_ahead)}};
}

nlohmann::ordered_json refused_json(const FrameTally& tally) {
  auto json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < kPoseRefusalNames.size(); ++i) {
    if (tally.poses_refused_by[i] > 0)
      json[std::string(kPoseRefusalNames[i])] = tally.poses_refused_by[i];
  }
  return json;
}

std::string dropped_text(const std::map<std::string, std::size_t>& dropped) {
  if (dropped.empty()) return "  dropped    none\n";
  std::size_t sum = 0;
  std::string reasons;
  for (const auto& [reason, count] : dropped) {
    sum += count;
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  }
  return fmt::format("  dropped    {} ({})\n", sum, reasons);
}

std::string files_text(const std::vector<SavedFile>& files) {
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [path, bytes, blocks, frames, voxels] = files[i];
    if (files.size() > 1) text += fmt::format("  world {:<4} {} frames\n", i + 1, frames);
    text += fmt::format("  voxels     {} occupied, {} free, {} unknown in {} blocks\n",
                        voxels.occupied, voxels.free, voxels.unknown, blocks);
    text += fmt::format("  map        {} ({})\n", path, size_text(bytes));
  }
  return text;
}

nlohmann::ordered_json file_json(const SavedFile& file) {
  return {{"path", file.path}, {"bytes", file.bytes}, {"blocks", file.blocks}};
}

nlohmann::ordered_json voxels_json(const VoxelCounts& voxels) {
  return {{"occupied", voxels.occupied}, {"free", voxels.free}, {"unknown", voxels.unknown}};
}

nlohmann::ordered_json latency_json(const Latency& latency) {
  nlohmann::ordered_json json{{"p50", milliseconds(latency.frame_percentile(0.50))},
                              {"p99", milliseconds(latency.frame_percentile(0.99))}};
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    json["stages"][std::string(kStageNames[i])] = {
        {"p50", milliseconds(latency.stage_percentile(stage, 0.50))},
        {"p99", milliseconds(latency.stage_percentile(stage, 0.99))}};
  }
  if (latency.has_ages()) {
    json["camera_to_map"] = {{"p50", milliseconds(latency.age_percentile(0.50))},
                             {"p99", milliseconds(latency.age_percentile(0.99))}};
  }
  return json;
}

}  // namespace

std::string size_text(std::uintmax_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (bytes >= 1'000'000'000) return fmt::format("{:.1f} GB", value * 1e-9);
  if (bytes >= 1'000'000) return fmt::format("{:.1f} MB", value * 1e-6);
  return bytes >= 1000 ? fmt::format("{:.1f} kB", value * 1e-3) : fmt::format("{} bytes", bytes);
}

std::string summary_text(const MappingSummary& s) {
  const double mapper_s = seconds(s.latency.total());
  std::string text = fmt::format("{}{}\n", s.source,
                                 s.was_interrupted ? " (interrupted; saved what was mapped)" : "");
  text += fmt::format("  frames     {} in {:.1f} s: {:.1f} fps with reading; mapper alone {:.1f}\n",
                      s.integrated(), s.elapsed_s, rate(s.integrated(), s.elapsed_s),
                      rate(s.integrated(), mapper_s));
  text += dropped_text(s.dropped());
  text += fmt::format("  intrinsics {}\n", text_of(s.intrinsics));
  if (!s.depth_doubt.empty()) text += fmt::format("  doubt      {}\n", s.depth_doubt);
  text += poses_text(s.source_tally, s.restarts);
  text += events_text(s.source_tally.events);
  if (s.late_frames > 0) {
    text += fmt::format("  deadline   {} frames late; {} far blocks left to later frames\n",
                        s.late_frames, s.blocks_left);
  }
  for (const std::string& note : s.notes) text += fmt::format("  note       {}\n", note);
  text += latency_text(s.latency);
  text += fmt::format("  window     {}; {} blocks evicted, {} restored\n",
                      size_text(s.memory_bytes), s.blocks_evicted, s.blocks_restored);
  if (s.blocks_lost > 0)
    text += fmt::format("  lost       the newest state of {} blocks: the disk refused them\n",
                        s.blocks_lost);
  return text + files_text(s.files);
}

std::string summary_json(const MappingSummary& s) {
  nlohmann::ordered_json json{
      {"source", s.source},
      {"intrinsics", {{"from", name_of(s.intrinsics.origin)}, {"detail", s.intrinsics.detail}}},
      {"depth_doubt", s.depth_doubt},
      {"frames", s.integrated()},
      {"dropped", s.dropped()},
      {"poses_refused", s.source_tally.poses_refused},
      {"poses_refused_by", refused_json(s.source_tally)},
      {"pose_jumps", s.source_tally.pose_jumps},
      {"stale_alarms", s.source_tally.stale_alarms},
      {"restarts", s.restarts},
      {"device_events", events_json(s.source_tally.events)},
      {"clock_steps",
       {{"poses", clock_json(s.source_tally.pose_clock)},
        {"images", clock_json(s.source_tally.image_clock)}}},
      {"notes", s.notes},
      {"elapsed_s", s.elapsed_s},
      {"fps", rate(s.integrated(), s.elapsed_s)},
      {"mapper_fps", rate(s.integrated(), seconds(s.latency.total()))},
      {"latency_ms", latency_json(s.latency)},
      {"late_frames", s.late_frames},
      {"blocks_left", s.blocks_left},
      {"memory_bytes", s.memory_bytes},
      {"blocks_evicted", s.blocks_evicted},
      {"blocks_restored", s.blocks_restored},
      {"blocks_lost", s.blocks_lost},
      {"was_interrupted", s.was_interrupted},
  };
  if (!s.files.empty()) {  // the first is the one that was asked for
    json["voxels"] = voxels_json(s.files.front().voxels);
    json["map"] = file_json(s.files.front());
  }
  json["maps"] = nlohmann::ordered_json::array();
  for (const SavedFile& file : s.files) {
    json["maps"].push_back(file_json(file));
    json["maps"].back()["frames"] = file.frames;
    json["maps"].back()["voxels"] = voxels_json(file.voxels);
  }
  return json_text(json) + "\n";
}

}  // namespace swiftlet::app
