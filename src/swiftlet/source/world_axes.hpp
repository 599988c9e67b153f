// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string_view>

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

/// The world of a recording, in whatever axes its makers chose.
struct NativeWorld {};

/// Conventions for the axes of a recording's world.
enum class WorldAxes : std::uint8_t {
  kZUp,      ///< x, y level, z up: ours, ROS, motion capture
  kOptical,  ///< those of the first camera: x right, y down, z forward; level as far as it was held
};

/// The native axis that points up, as in "-y".
[[nodiscard]] std::string_view up_axis(WorldAxes axes);

/// Turns the native world into ours (z up). The origins coincide.
[[nodiscard]] Transform<World, NativeWorld> world_from(WorldAxes axes);

}  // namespace swiftlet
