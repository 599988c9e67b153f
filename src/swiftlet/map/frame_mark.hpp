// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// The newest frame that a map holds: how old it is, and from where it was seen.
struct FrameMark {
  std::uint64_t frame_count = 0;  ///< frames integrated so far; 0: the rest means nothing
  Stamp stamp{};                  ///< of the newest of them, in its source's clock
  Transform<World, Camera> T_world_camera{};  ///< where its camera was
};

}  // namespace swiftlet
