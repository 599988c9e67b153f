// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>

#include "swiftlet/query/known_voxels.hpp"
#include "swiftlet/store/export/exporters.hpp"

namespace swiftlet {

/// Reports to `progress` once in a while, as the blocks go by.
class BlockProgress {
 public:
  BlockProgress(const SavedMap& map, const ExportProgress& progress)
      : total_(map.block_count()), progress_(progress) {}
  void next() {
    constexpr std::uint64_t kEvery = 256;
    if (progress_ && ++done_ % kEvery == 0) {
      progress_(static_cast<double>(done_) / static_cast<double>(total_));
    }
  }
  void finish() {
    if (progress_) progress_(1.0);
  }

 private:
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  const ExportProgress& progress_;
};

/// Calls visit(VoxelIndex, QuantizedLogOdds, Occupancy) for every free and occupied voxel of a map
/// file, block by block.
template <class Visit>
[[nodiscard]] Status for_each_known_voxel(const SavedMap& map, const ExportProgress& progress,
                                          Visit&& visit) {
  BlockProgress blocks(map, progress);
  auto passed = map.for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    for_each_known_voxel(index, block, map.thresholds(), visit);
    blocks.next();
    return Done{};
  });
  if (passed) blocks.finish();
  return passed;
}

}  // namespace swiftlet
