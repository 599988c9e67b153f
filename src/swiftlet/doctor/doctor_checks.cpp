// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/doctor/doctor_checks.hpp"

// A check is one function, check_<name>(), in one of the files doctor_*.cpp, and one line here.
#define SWIFTLET_DOCTOR_CHECKS(X)                                          \
  X(sdk, "the RealSense SDK is built in and can talk to the devices")      \
  X(devices, "there is a depth camera and a source of poses")              \
  X(firmware, "no device has older firmware than its SDK recommends")      \
  X(usb, "every depth camera is on a USB 3 port")                          \
  X(profile, "every depth camera offers 848x480 at 30 Hz")                 \
  X(reading, "the source can be opened and read")                          \
  X(intrinsics, "somebody tells the intrinsics of the cameras")            \
  X(mounts, "rotation, distance and direction of each camera's mount")     \
  X(clocks, "images and poses are stamped by one clock")                   \
  X(depth_rate, "images come evenly and in order")                         \
  X(pose_rate, "poses come often enough to interpolate, and without gaps") \
  X(overlap, "images and poses are of the same time")                      \
  X(confidence, "the tracker trusts its poses")                            \
  X(poses, "poses are numbers, level, move, and do not jump")              \
  X(depth_units, "the unit of depth makes sense of what is seen")          \
  X(readings, "enough pixels hold a depth")                                \
  X(frames, "images get their pose and reach the mapper")

namespace swiftlet::doctor {

#define SWIFTLET_DECLARE(name, summary) \
  void check_##name(const DoctorExam& exam, std::vector<Finding>& findings);
SWIFTLET_DOCTOR_CHECKS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<DoctorCheck>> doctor_checks() {
#define SWIFTLET_LINE(name, summary) Registered<DoctorCheck>{#name, summary, check_##name},
  static constexpr auto kChecks = std::to_array({SWIFTLET_DOCTOR_CHECKS(SWIFTLET_LINE)});
#undef SWIFTLET_LINE
  return kChecks;
}

}  // namespace swiftlet::doctor
