// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/source/rig/mounts.hpp"
#include "swiftlet/source/rig/rig.hpp"

namespace swiftlet {

/// A rig as its file describes it (docs/rig.md): cameras, their mounts, the gates of the poses.
struct RigDescription {
  RigOptions rig;                          ///< cameras, mounts and gates
  std::string pose_stream{};               ///< topic of the poses; empty: found
  std::string body_frame{};                ///< child frame in a tf topic
  BodyAxes pose_axes = BodyAxes::kRep103;  ///< how the tracker counts its axes
};

/// The gates that fit a T265: medium confidence, 10 m/s, jumps taken out.
[[nodiscard]] PoseGates tracker_gates();

/// Two cameras on Intel's printed bracket.
[[nodiscard]] RigDescription intel_t265_d435_rig();

/// Errors: kNotFound, kIo; kInvalidConfig naming file and line: a key that is not known, a value
/// out of its limits, a mount that cannot be meant (see check_mount()).
[[nodiscard]] Expected<RigDescription> load_rig(const std::filesystem::path& path);
/// The same of a text; `origin` is what errors name.
[[nodiscard]] Expected<RigDescription> parse_rig(std::string_view yaml, std::string_view origin);

}  // namespace swiftlet
