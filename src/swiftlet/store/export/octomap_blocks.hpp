// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/block_map.hpp"
#include "swiftlet/store/export/octomap_import.hpp"

namespace swiftlet {

/// The blocks of an OctoMap, its large leaves cut into voxels.
struct OctomapBlocks {
  /// A few bytes may claim 65536 x 65536 x 65536 voxels: more than these are not laid out (1/8
  /// GiB).
  static constexpr std::uint64_t kMostBlocks = std::uint64_t{1} << 18U;
  /// What a .bt, which does not tell it, says of a voxel: OctoMap's own clamping limits.
  static constexpr float kFree_logodds = -2.0F;
  static constexpr float kOccupied_logodds = 3.5F;

  OctomapSummary summary;
  BlockMap blocks;
};

/// Reads a .bt or .ot as blocks. A voxel keeps its state under `thresholds`, whatever its log-odds.
/// Errors: those of read_octomap(); kUnsupported if it has more than kMostBlocks.
[[nodiscard]] Expected<OctomapBlocks> read_octomap_blocks(const std::filesystem::path& path,
                                                          const OccupancyThresholds& thresholds);

}  // namespace swiftlet
