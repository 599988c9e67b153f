// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/export/octomap_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet {
namespace {

QuantizedLogOdds voxel_of(float log_odds, bool is_occupied, const LogOddsScale& scale) {
  const OccupancyThresholds& thresholds = scale.thresholds;
  const float steps = std::round(log_odds / static_cast<float>(scale.logodds_per_step));
  const float kept = std::isfinite(steps) ? std::clamp(steps, -128.0F, 128.0F) : 0.0F;
  const int voxel = kUnknownVoxel + static_cast<int>(kept);
  return static_cast<QuantizedLogOdds>(
      is_occupied ? std::clamp(voxel, thresholds.occupied_from, int{kOccupiedVoxel})
                  : std::clamp(voxel, int{kFreeVoxel}, thresholds.free_below - 1));
}

/// Lays out leaves as long as there is room.
class BlockFiller {
 public:
  BlockFiller(OctomapBlocks& out, const LogOddsScale& scale) : out_(out), scale_(scale) {}

  void add(const OctomapLeaf& leaf) {
    // The log-odds of a .bt's leaf are 0.
    const float of_state =
        leaf.is_occupied ? OctomapBlocks::kOccupied_logodds : OctomapBlocks::kFree_logodds;
    const QuantizedLogOdds voxel =
        voxel_of(leaf.log_odds == 0.0F ? of_state : leaf.log_odds, leaf.is_occupied, scale_);
    leaf.edge < kBlockEdge ? fill_voxels(leaf, voxel) : fill_blocks(leaf, voxel);
  }
  [[nodiscard]] bool is_full() const { return is_full_; }

 private:
  VoxelBlock* block(const BlockIndex& index) {
    const bool is_new = out_.blocks.find(index) == nullptr;
    if (is_new && out_.blocks.block_count() >= OctomapBlocks::kMostBlocks) is_full_ = true;
    return is_new && is_full_ ? nullptr : &out_.blocks.writable(index);
  }

  /// A leaf that is smaller than a block lies within one: both are cut at multiples of their edge.
  void fill_voxels(const OctomapLeaf& leaf, QuantizedLogOdds voxel) {
    VoxelBlock* const target = block(block_of(leaf.first));
    if (target == nullptr) return;
    const VoxelIndex& f = leaf.first;
    for (std::int32_t z = f.z; z < f.z + leaf.edge; ++z) {
      for (std::int32_t y = f.y; y < f.y + leaf.edge; ++y) {
        for (std::int32_t x = f.x; x < f.x + leaf.edge; ++x)
          target->voxels[offset_in_block({x, y, z})] = voxel;
      }
    }
  }

  void fill_blocks(const OctomapLeaf& leaf, QuantizedLogOdds voxel) {
    const std::int32_t edge = leaf.edge / kBlockEdge;
    const auto blocks = static_cast<std::uint64_t>(edge) * static_cast<std::uint64_t>(edge) *
                        static_cast<std::uint64_t>(edge);
    is_full_ = is_full_ || blocks > OctomapBlocks::kMostBlocks;
    const BlockIndex first = block_of(leaf.first);
    for (std::int32_t z = 0; z < edge && !is_full_; ++z) {
      for (std::int32_t y = 0; y < edge; ++y) {
        for (std::int32_t x = 0; x < edge; ++x) {
          VoxelBlock* const target = block({first.x + x, first.y + y, first.z + z});
          if (target != nullptr) target->voxels.fill(voxel);
        }
      }
    }
  }

  OctomapBlocks& out_;
  const LogOddsScale& scale_;
  bool is_full_ = false;
};

}  // namespace

Expected<OctomapBlocks> read_octomap_blocks(const std::filesystem::path& path,
                                            const OccupancyThresholds& thresholds) {
  OctomapBlocks out;
  const LogOddsScale scale{thresholds};
  BlockFiller filler(out, scale);
  auto summary = read_octomap(path, [&](const OctomapLeaf& leaf) { filler.add(leaf); });
  if (!summary) return forward_error(std::move(summary));
  if (filler.is_full()) {
    return fail(ErrorCode::kUnsupported, path.string(),
                fmt::format("its leaves stand for {:.3g} voxels, too many to lay out one by one",
                            static_cast<double>(summary->free_voxels + summary->occupied_voxels)),
                "'swiftlet info' and 'swiftlet compare' read it leaf by leaf");
  }
  out.summary = std::move(*summary);
  out.blocks.set_header({out.summary.voxel_m, scale});
  return out;
}

}  // namespace swiftlet
