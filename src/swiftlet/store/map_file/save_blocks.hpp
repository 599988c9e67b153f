// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <span>
#include <utility>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/voxel_block.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// Saves blocks that are at hand as a new map file, in one transaction. `meta` holds `voxel_m` and
/// `frames` (docs/formats/map_file.md). Errors: kUsage if the file exists; kIo, and there is none.
[[nodiscard]] Status save_blocks(const std::filesystem::path& path,
                                 std::span<const std::pair<BlockIndex, VoxelBlock>> blocks,
                                 const MapMeta& meta);

}  // namespace swiftlet
