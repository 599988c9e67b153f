// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"
#include "swiftlet/session/session_observer.hpp"

namespace swiftlet {

/// A map that a vehicle flies on, whoever makes it: frames go in, and a planner sees a window of
/// voxels.
class FlownMap {
 public:
  virtual ~FlownMap() = default;
  /// False if the frame was refused.
  virtual bool integrate(const Frame& frame) = 0;
  /// What the planner sees; unknown voxels may be written to.
  [[nodiscard]] virtual RollingMap& window() = 0;
  [[nodiscard]] virtual std::uint64_t frame_count() const = 0;
  /// Free and occupied voxels, those that have left the window included.
  [[nodiscard]] virtual std::size_t known_voxels() const = 0;
};
using FlownMapPtr = std::unique_ptr<FlownMap>;

/// Swiftlet's own. `observer`, if any, is told of the flight and outlives the map.
/// Errors: those of Mapper::create().
[[nodiscard]] Expected<FlownMapPtr> make_swiftlet_map(const MapperConfig& config,
                                                      SessionObserver* observer = nullptr);
/// OctoMap's, with its own sensor model and its claims; of `config` it takes voxels, window and
/// range. Errors: also kUnsupported if this build has no OctoMap.
[[nodiscard]] Expected<FlownMapPtr> make_octomap_map(const MapperConfig& config);

/// One of them by name: `swiftlet`, `octomap`. Errors: kUsage for another name.
[[nodiscard]] Expected<FlownMapPtr> make_flown_map(std::string_view name,
                                                   const MapperConfig& config);

}  // namespace swiftlet
