// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/map/block_map.hpp"

namespace swiftlet::render {

/// The map in voxels of so many along each axis: occupied if one of them is, else free if one is.
[[nodiscard]] BlockMap coarser_map(const BlockMap& map, int voxels);

}  // namespace swiftlet::render
