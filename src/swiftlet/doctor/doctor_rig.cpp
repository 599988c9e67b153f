// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swiftlet/base/angle.hpp"
#include "swiftlet/doctor/doctor_checks.hpp"
#include "swiftlet/source/rig/mounts.hpp"

// Where the cameras sit, what they see, and whether the poses can be a vehicle's.

namespace swiftlet::doctor {
namespace {

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

bool is_intel_mount(const Transform<Body, Camera>& mount) {
  const auto preset = intel_t265_d435_mount();
  return (mount.translation() - preset.translation()).norm() < 1e-6 &&
         mount.rotation().angularDistance(preset.rotation()) < 1e-6;
}

/// The direction of kDirections nearest to the optical axis.
std::string_view looks(const Transform<Body, Camera>& mount) {
  const auto fits = [&](std::string_view direction) {
    return check_mount(mount, direction).has_value();
  };
  const auto found = std::ranges::find_if(kDirections, fits);
  return found != kDirections.end() ? *found : "between the axes";
}

}  // namespace

void check_reading(const DoctorExam& exam, std::vector<Finding>& findings) {
  for (const std::string& choice : exam.choices) findings.push_back({Severity::kGood, choice});
  if (!exam.fault) return;
  const Error& fault = *exam.fault;
  const std::string what = fault.where.empty() ? fault.what : fault.where + ": " + fault.what;
  findings.push_back(
      {Severity::kFault, what,
       fault.remedy.empty() ? "check the address, the cable or the file" : fault.remedy});
}

void check_intrinsics(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.intrinsics) return;
  const std::string told = text_of(*exam.intrinsics);
  switch (exam.intrinsics->origin) {
    case IntrinsicsOrigin::kUntold:
      findings.push_back({Severity::kWarning, "the source does not say where they come from",
                          "see that they are those of the camera: wrong ones bend the map"});
      break;
    case IntrinsicsOrigin::kKnownDataset:
      findings.push_back({Severity::kNote, told,
                          "if another camera has recorded this, add a camera-intrinsics.txt"});
      break;
    default:
      findings.push_back({Severity::kGood, told});
  }
}

void check_mounts(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts) return;
  for (std::size_t i = 0; i < exam.rig.cameras.size(); ++i) {
    const auto& mount = exam.rig.cameras[i].T_body_camera;
    const std::string who = exam.rig.cameras[i].title();
    if (auto sound = check_mount(mount, {}); !sound) {
      findings.push_back(
          {Severity::kFault, fmt::format("{}: {}", who, sound.error().what), sound.error().remedy});
      continue;
    }
    const Eigen::Vector3d& t = mount.translation();
    findings.push_back(
        {Severity::kGood,
         fmt::format("{}: determinant {:+.3f}, {:.3f} m from the body's origin ({:+.3f}, {:+.3f}, "
                     "{:+.3f}), looks {}",
                     who, mount.rotation().toRotationMatrix().determinant(), t.norm(), t.x(), t.y(),
                     t.z(), looks(mount))});
    if (is_intel_mount(mount) && exam.is_t265) {
      findings.push_back(
          {Severity::kNote,
           fmt::format("{}: Intel's bracket as published, one unit's calibration", who),
           "yours differs by millimetres: calibrate it and give a rig file"});
    } else if (is_intel_mount(mount) && !exam.subject.starts_with("sim:")) {
      findings.push_back({Severity::kWarning,
                          fmt::format("{}: Intel's bracket, but the poses are no T265's", who),
                          "describe where the camera sits in a rig file (docs/rig.md)"});
    }
  }
}

void check_confidence(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts || exam.facts->poses.samples == 0) return;
  const PoseFacts& poses = exam.facts->poses;
  const std::size_t least = exam.rig.poses.gates.min_confidence;
  std::size_t low = 0;
  for (std::size_t i = 0; i < std::min(least, poses.confidence.size()); ++i)
    low += poses.confidence[i];
  const auto& c = poses.confidence;
  const double share = percent(low, poses.samples);
  // A T265 is not sure of itself for a moment after its start.
  const double low_s = static_cast<double>(low) / std::max(1.0, poses.rate_hz());
  const bool is_bad = share > 20.0 && low_s > 0.5;
  findings.push_back(
      {is_bad ? Severity::kWarning : Severity::kGood,
       fmt::format("{} failed, {} low, {} medium, {} high; {:.1f} % below the gate of {}", c[0],
                   c[1], c[2], c[3], share, least),
       is_bad ? "light and texture in the tracker's sight; move slowly at the start" : ""});
}

void check_poses(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts || exam.facts->poses.samples == 0) return;
  const PoseFacts& poses = exam.facts->poses;
  const std::size_t before = findings.size();
  if (poses.broken > 0)
    findings.push_back(
        {Severity::kWarning,
         fmt::format("{} of {} poses are not finite or no rotation", poses.broken, poses.samples),
         "they are refused and counted; look for what writes them"});
  // Of a pose of the camera itself nobody can tell which way is up: z is its optical axis.
  const auto& cameras = exam.rig.cameras;
  const bool is_of_camera =
      !cameras.empty() && std::ranges::all_of(cameras, [](const RigCamera& camera) {
        return camera.T_body_camera.rotation().isApprox(Eigen::Quaterniond::Identity());
      });
  if (is_of_camera)
    findings.push_back({Severity::kNote,
                        "they are of the camera itself, so nobody can tell whether it is upright",
                        "if the map lies on its side, check pose.axes"});
  else if (poses.least_tilt_rad && *poses.least_tilt_rad > std::numbers::pi / 3)
    findings.push_back(
        {Severity::kFault,
         fmt::format("the body is never less than {:.0f} degrees from upright",
                     degrees(*poses.least_tilt_rad)),
         "the axes of the poses are others than told: check pose.axes (rep103: x forward, "
         "y left, z up; t265: x right, y up, z backward)"});
  constexpr auto kBadStamp = static_cast<std::size_t>(PoseRefusal::kBadStamp);
  if (const std::size_t bad = exam.tally.poses_refused_by[kBadStamp]; bad > 0)
    findings.push_back(
        {Severity::kWarning,
         fmt::format("the stamps of {} poses agree neither with those before nor after", bad),
         "they are refused and counted (bad_stamp); look for what stamps them"});
  if (exam.tally.pose_jumps > 0)
    findings.push_back({Severity::kWarning,
                        fmt::format("the pose source has jumped {} times", exam.tally.pose_jumps),
                        "switch relocalisation and pose jumping off; more texture in its sight"});
  const double extent_m = (poses.high_m - poses.low_m).norm();
  if (extent_m < 1e-3 && seconds(poses.duration()) > 1.0)
    findings.push_back({Severity::kNote, "the body has not moved by a millimetre",
                        "carry the rig about while it is examined"});
  if (findings.size() == before)
    findings.push_back({Severity::kGood,
                        fmt::format("all {} are numbers and level; the body moved within {:.2f} m",
                                    poses.samples, extent_m)});
}

void check_depth_units(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.depth_doubt.empty()) {
    findings.push_back({Severity::kWarning, exam.depth_doubt,
                        "say it behind the folder, as in ?depth_unit_m=0.001"});
  }
  if (!exam.facts) return;
  for (std::size_t i = 0; i < exam.facts->cameras.size(); ++i) {
    const CameraStatistics& camera = exam.facts->cameras[i];
    if (camera.samples == 0) continue;
    std::vector<float> medians = exam.readings[i].medians_m;
    std::ranges::sort(medians);
    const double median_m = medians.empty() ? 0.0 : double{medians[medians.size() / 2]};
    const bool is_odd = !medians.empty() && !(median_m > 0.1 && median_m < 15.0);
    const std::string seen =
        medians.empty() ? ""
                        : fmt::format("; half of what it sees is nearer than {:.2f} m", median_m);
    findings.push_back(
        {is_odd ? Severity::kWarning : Severity::kGood,
         fmt::format("{}: {:g} m a step{}", exam.rig.cameras[i].title(), camera.unit_m, seen),
         is_odd ? "that is no room: check Depth Units (D435: 0.001, D405: 0.0001) or depth_unit_m"
                : ""});
  }
}

void check_readings(const DoctorExam& exam, std::vector<Finding>& findings) {
  for (std::size_t i = 0; i < exam.readings.size(); ++i) {
    const DepthStatistics& readings = exam.readings[i];
    if (readings.pixels == 0) continue;
    const double share = percent(readings.readings, readings.pixels);
    findings.push_back(
        {share < 25.0 ? Severity::kWarning : Severity::kGood,
         fmt::format("{}: {:.0f} % of the pixels hold a depth", exam.rig.cameras[i].title(), share),
         share < 25.0 ? "emitter and auto-exposure on? not nearer than 0.3 m? lens clean?" : ""});
  }
}

void check_frames(const DoctorExam& exam, std::vector<Finding>& findings) {
  if (!exam.facts) return;
  std::size_t lost = 0;
  std::string reasons;
  for (std::size_t i = 0; i < kFrameLossNames.size(); ++i) {
    if (exam.tally.lost[i] == 0) continue;
    lost += exam.tally.lost[i];
    reasons +=
        fmt::format("{}{} {}", reasons.empty() ? "" : ", ", exam.tally.lost[i], kFrameLossNames[i]);
  }
  const std::size_t all = exam.tally.delivered + lost;
  if (all == 0) return;
  const double share = percent(exam.tally.delivered, all);
  findings.push_back({share <= 0.0   ? Severity::kFault
                      : share < 90.0 ? Severity::kWarning
                                     : Severity::kGood,
                      fmt::format("{} of {} images got their pose{}{}", exam.tally.delivered, all,
                                  reasons.empty() ? "" : "; lost: ", reasons),
                      share < 90.0 ? "docs/rig.md says what each reason means" : ""});
}

}  // namespace swiftlet::doctor
