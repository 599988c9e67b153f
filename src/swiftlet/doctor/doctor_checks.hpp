// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/realsense/realsense.hpp"
#include "swiftlet/source/rig/rig.hpp"

namespace swiftlet::doctor {

enum class Severity : std::uint8_t {
  kGood,
  kNote,     ///< worth knowing
  kWarning,  ///< the map will be worse than it could be
  kFault,    ///< there will be no map, or a wrong one
};
inline constexpr std::array<std::string_view, 4> kSeverityNames{"good", "note", "warning", "fault"};

/// What a check has found, and what to do about it.
struct Finding {
  Severity severity;
  std::string what;      ///< one sentence with the figures, no capital, no full stop
  std::string remedy{};  ///< empty where there is nothing to do
};

/// The pixels of a camera's frames.
struct DepthStatistics {
  std::size_t pixels = 0;
  std::size_t readings = 0;        ///< that hold a depth
  std::vector<float> medians_m{};  ///< of each frame
};

/// A rig, as far as it could be examined; what is absent was not there to be asked.
struct DoctorExam {
  std::string subject;                      ///< address of the source; empty: the devices alone
  std::optional<RealsenseSystem> system{};  ///< live devices
  std::optional<Error> no_system{};         ///< why they could not be asked
  std::optional<Error> fault{};             ///< why the source could not be opened, or read on
  std::vector<std::string> choices{};       ///< SourceInfo::choices
  std::optional<RigStatistics> facts{};
  RigOptions rig{};
  FrameTally tally{};
  std::vector<DepthStatistics> readings{};     ///< by camera of the rig
  bool is_t265 = false;                        ///< the poses are a T265's
  std::optional<IntrinsicsNote> intrinsics{};  ///< where those of the cameras came from
  std::string depth_doubt{};                   ///< why the unit of depth looks wrong
};

/// Appends what it finds; nothing where there is nothing to examine.
using DoctorCheck = void (*)(const DoctorExam& exam, std::vector<Finding>& findings);

/// All checks, in the order of the report.
[[nodiscard]] std::span<const Registered<DoctorCheck>> doctor_checks();

}  // namespace swiftlet::doctor
