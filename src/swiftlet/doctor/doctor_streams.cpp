// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/doctor/doctor_checks.hpp"
#include "swiftlet/session/source_notes.hpp"

// The times of what has come: clocks, rates, overlap.

namespace swiftlet::doctor {
namespace {

/// The clock of most samples.
ClockDomain clock_of(const StreamStatistics& stream) {
  const auto most = std::ranges::max_element(stream.clocks);
  return static_cast<ClockDomain>(most - stream.clocks.begin());
}

double in_ms(Nanoseconds t) { return seconds(t) * 1e3; }

void check_mixture(std::string_view who, const StreamStatistics& stream,
                   std::vector<Finding>& findings) {
  const std::size_t most = *std::ranges::max_element(stream.clocks);
  if (stream.samples == most) return;
  findings.push_back({Severity::kNote,
                      fmt::format("{}: {} of {} samples are not stamped by {}", who,
                                  stream.samples - most, stream.samples, name_of(clock_of(stream))),
                      "a D435 starts with its own clock until it knows the host's; these are "
                      "refused and counted"});
}

void check_clock_of(std::string_view who, const StreamStatistics& images, const PoseFacts& poses,
                    std::vector<Finding>& findings) {
  const ClockDomain a = clock_of(images);
  const ClockDomain b = clock_of(poses);
  if (!is_same_clock(a, b)) {
    findings.push_back(
        {Severity::kFault,
         fmt::format("{} is stamped by {} and the poses by {}: nobody can tell which "
                     "belong together",
                     who, name_of(a), name_of(b)),
         "on one host with the option Global Time Enabled on, and a kernel that passes "
         "UVC metadata, both use global time"});
    return;
  }
  if (a == ClockDomain::kSystem) {
    findings.push_back(
        {Severity::kWarning,
         fmt::format("{} is stamped on arrival, late by exposure and transfer", who),
         "use a kernel with UVC metadata (the SDK's patch, or its libuvc backend), or "
         "calibrate pose_offset_s in the rig file"});
    return;
  }
  findings.push_back(
      {Severity::kGood, fmt::format("{}: {}; poses: {}", who, name_of(a), name_of(b))});
}

/// What only a whole recording tells of its cameras.
void check_continuity(const DoctorExam& exam, std::vector<Finding>& findings) {
  constexpr auto kBadStamp = static_cast<std::size_t>(FrameLoss::kBadStamp);
  if (const std::size_t bad = exam.tally.lost[kBadStamp]; bad > 0) {
    findings.push_back(
        {Severity::kWarning,
         fmt::format("the stamps of {} images agree neither with those before nor after", bad),
         "they are lost (bad_stamp); look for what stamps them"});
  }
  const bool has_seen = std::ranges::any_of(exam.facts->cameras, &CameraStatistics::samples);
  if (has_seen && exam.facts->cameras.size() > 1) {
    for (std::string& note : silence_notes(*exam.facts, exam.rig)) {
      findings.push_back({Severity::kWarning, std::move(note),
                          "its cable or its power: the map lacks what it would have seen"});
    }
  }
  for (std::string& note : intrinsics_notes(*exam.facts, exam.rig)) {
    findings.push_back({Severity::kNote, std::move(note),
                        "if the camera was not switched on purpose, find what publishes another "
                        "CameraInfo"});
  }
}

}  // namespace

void check_clocks(const DoctorExam& exam, std::vector<Finding>& findings) {
  for (std::string& note : clock_notes(exam.tally)) {
    findings.push_back({Severity::kWarning, std::move(note),
                        "set the clock of the computer before the flight (docs/rig.md, \"Time\")"});
  }
  if (!exam.facts || exam.facts->poses.samples == 0) return;
  check_mixture("poses", exam.facts->poses, findings);
  for (std::size_t i = 0; i < exam.facts->cameras.size(); ++i) {
    const CameraStatistics& camera = exam.facts->cameras[i];
    if (camera.samples == 0) continue;
    check_mixture(exam.rig.cameras[i].title(), camera, findings);
    check_clock_of(exam.rig.cameras[i].title(), camera, exam.facts->poses, findings);
  }
}

void check_depth_rate(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts) return;
  check_continuity(exam, findings);
  for (std::size_t i = 0; i < exam.facts->cameras.size(); ++i) {
    const CameraStatistics& camera = exam.facts->cameras[i];
    const std::string who = exam.rig.cameras[i].title();
    if (camera.samples == 0) {
      findings.push_back(
          {Severity::kFault, who + ": no image has come",
           "check its cable, its serial number or topic, and that no other program uses it"});
      continue;
    }
    const double rate_hz = camera.rate_hz();
    const double period_ms = rate_hz > 0.0 ? 1e3 / rate_hz : 0.0;
    // The image after each time that the clock was set back is no fault of the recording.
    const std::size_t backward =
        camera.backward - std::min(camera.backward, exam.tally.image_clock.back);
    if (backward > 0) {
      findings.push_back({Severity::kWarning,
                          fmt::format("{}: {} of {} images are not later than the one before", who,
                                      backward, camera.samples),
                          "they are lost (out_of_order); record each camera once"});
    }
    const bool has_gap = in_ms(camera.longest_gap) > std::max(200.0, 5.0 * period_ms);
    findings.push_back(
        {has_gap ? Severity::kWarning : Severity::kGood,
         fmt::format("{}: {} images, {:.1f} Hz, longest gap {:.0f} ms", who, camera.samples,
                     rate_hz, in_ms(camera.longest_gap)),
         has_gap ? "a USB port of its own, a shorter cable, or a smaller profile" : ""});
  }
}

void check_pose_rate(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts) return;
  const PoseFacts& poses = exam.facts->poses;
  if (poses.samples == 0) {
    findings.push_back({Severity::kFault, "no pose has come",
                        "check the tracker's cable (a port of its own), or what feeds the poses"});
    return;
  }
  const double rate_hz = poses.rate_hz();
  const double expected_hz = exam.is_t265 ? 100.0 : 20.0;
  const bool is_slow = poses.samples > 1 && rate_hz < expected_hz;
  const bool has_gap = poses.longest_gap > exam.rig.poses.track.max_gap;
  std::string remedy;
  if (is_slow)
    remedy = "a T265 gives 200 poses a second: share no hub with it, and record all of them";
  if (has_gap)
    remedy = fmt::format("images in gaps above {:.0f} ms are lost (pose_gap): a port of its own",
                         in_ms(exam.rig.poses.track.max_gap));
  findings.push_back({is_slow || has_gap ? Severity::kWarning : Severity::kGood,
                      fmt::format("{} poses, {:.1f} Hz, longest gap {:.0f} ms", poses.samples,
                                  rate_hz, in_ms(poses.longest_gap)),
                      std::move(remedy)});
}

void check_overlap(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts || !exam.facts->poses.first) return;
  const PoseFacts& poses = exam.facts->poses;
  for (std::size_t i = 0; i < exam.facts->cameras.size(); ++i) {
    const CameraStatistics& camera = exam.facts->cameras[i];
    if (!camera.first || !is_same_clock(clock_of(camera), clock_of(poses))) continue;
    const Nanoseconds offset = exam.rig.cameras[i].pose_offset;
    const Stamp first = std::max(*camera.first + offset, *poses.first);
    const Stamp last = std::min(*camera.last + offset, *poses.last);
    const double all_s = seconds(camera.duration());
    const double common_s = std::max(0.0, seconds(last - first));
    const double share =
        all_s > 0.0 ? std::min(1.0, common_s / all_s) : (first <= last ? 1.0 : 0.0);
    const Severity severity = share <= 0.0  ? Severity::kFault
                              : share < 0.9 ? Severity::kWarning
                                            : Severity::kGood;
    findings.push_back(
        {severity,
         fmt::format(
             "{}: poses cover {:.0f} % of its time ({:+.3f} s at its start, {:+.3f} s at its end)",
             exam.rig.cameras[i].title(), 100.0 * share,
             seconds(*poses.first - *camera.first - offset),
             seconds(*poses.last - *camera.last - offset)),
         severity == Severity::kGood
             ? ""
             : "start the tracker before the camera and stop it after; if their "
               "clocks differ by a constant, set pose_offset_s"});
  }
}

}  // namespace swiftlet::doctor
