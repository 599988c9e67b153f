// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet::station {

/// The map as it was after a whole frame, for a client that asks for all of it.
struct MapCopy {
  double voxel_m = 0.0;
  std::uint64_t frame_count = 0;                          ///< 0 of a saved map
  std::vector<std::pair<BlockIndex, VoxelBlock>> blocks;  ///< by z, then y, then x
};

/// Makes the map file of a copy, as bytes. Called in a thread of its own, one call at a time.
using MapSaver = std::function<Expected<std::vector<std::uint8_t>>(const MapCopy&)>;
using SharedBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

}  // namespace swiftlet::station
