// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

/// The world of a recording, in whatever axes its makers chose.
struct NativeWorld {};

/// Conventions for the axes of a recording's world, by the one that points up.
enum class WorldAxes : std::uint8_t {
  kZUp,      ///< x, y level, z up: ours, ROS, motion capture
  kOptical,  ///< -y up: those of the first camera, x right, y down, z forward; level as it was held
  kYUp,      ///< x right, z backward: computer graphics, the T265
  kZDown,    ///< x forward, y right: aircraft
  kXUp,
  kXDown,
};

/// The native axis that points up, as in "-y".
[[nodiscard]] std::string_view up_axis(WorldAxes axes);
/// The axes whose up_axis() is that, "z" being "+z"; nullopt for other words.
[[nodiscard]] std::optional<WorldAxes> axes_with_up(std::string_view axis);

/// Turns the native world into ours (z up). The origins coincide.
[[nodiscard]] Transform<World, NativeWorld> world_from(WorldAxes axes);

}  // namespace swiftlet
