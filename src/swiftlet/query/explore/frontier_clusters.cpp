// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/explore/frontier_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "swiftlet/base/grid_ray.hpp"

namespace swiftlet {
namespace {

constexpr std::array<VoxelIndex, 6> kFaces{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

VoxelIndex shifted(const VoxelIndex& v, const VoxelIndex& by) {
  return {v.x + by.x, v.y + by.y, v.z + by.z};
}

/// The cells that belong to no cluster yet, by block.
class CellsLeft {
 public:
  explicit CellsLeft(const FrontierMap& frontier) {
    frontier.for_each_cell([&](const VoxelIndex& v) { blocks_[block_of(v)][word(v)] |= bit(v); });
  }
  /// Takes a cell out; false if it is not there.
  bool take(const VoxelIndex& v) {
    const auto found = blocks_.find(block_of(v));
    if (found == blocks_.end() || (found->second[word(v)] & bit(v)) == 0) return false;
    found->second[word(v)] &= ~bit(v);
    return true;
  }

 private:
  [[nodiscard]] static std::size_t word(const VoxelIndex& v) { return offset_in_block(v) / 64U; }
  [[nodiscard]] static std::uint64_t bit(const VoxelIndex& v) {
    return std::uint64_t{1} << (offset_in_block(v) % 64U);
  }
  std::unordered_map<BlockIndex, BlockBits, BlockHash> blocks_;
};

/// Grows a box by a cell, unless an edge would be longer than `most` cells.
bool try_include(VoxelBox& box, const VoxelIndex& v, std::int32_t most) {
  VoxelBox larger = box;
  larger.include(v);
  const std::int32_t edge =
      std::max({larger.last.x - larger.first.x, larger.last.y - larger.first.y,
                larger.last.z - larger.first.z});
  if (edge >= most) return false;
  box = larger;
  return true;
}

/// Moves all cells that hang together with `seed` to the end of `cells`.
void gather(const VoxelIndex& seed, std::int32_t most, CellsLeft& left,
            std::vector<VoxelIndex>& cells) {
  VoxelBox box{seed, seed};
  std::size_t next = cells.size();
  cells.push_back(seed);
  for (; next < cells.size(); ++next) {
    const VoxelIndex at = cells[next];
    for (int i = 0; i < 27; ++i) {
      const VoxelIndex v = shifted(at, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1});
      VoxelBox larger = box;
      if (!try_include(larger, v, most) || !left.take(v)) continue;
      box = larger;
      cells.push_back(v);
    }
  }
}

FrontierCluster describe(const FrontierMap& frontier, const std::vector<VoxelIndex>& cells,
                         std::size_t first) {
  FrontierCluster cluster{first, cells.size() - first};
  for (std::size_t i = first; i < cells.size(); ++i) {
    cluster.centroid_m += centre_of(cells[i], frontier.voxel_m());
    for (const VoxelIndex& face : kFaces) {
      if (frontier.is_unknown(shifted(cells[i], face)))
        cluster.normal += Eigen::Vector3d(face.x, face.y, face.z);
    }
  }
  cluster.centroid_m /= static_cast<double>(cluster.cell_count);
  // Whole numbers: they cancel out exactly or not at all.
  if (!cluster.normal.isZero(0.0)) cluster.normal.normalize();
  return cluster;
}

}  // namespace

FrontierClusters cluster_frontier(const FrontierMap& frontier, const ClusterOptions& options) {
  FrontierClusters result;
  CellsLeft left(frontier);
  const double most = std::clamp(std::floor(options.max_extent_m / frontier.voxel_m()), 1.0, 1e6);
  frontier.for_each_cell([&](const VoxelIndex& seed) {
    if (!left.take(seed)) return;
    const std::size_t first = result.cells.size();
    gather(seed, static_cast<std::int32_t>(most), left, result.cells);
    if (result.cells.size() - first < options.min_cells) {
      result.cells.resize(first);
    } else {
      result.clusters.push_back(describe(frontier, result.cells, first));
    }
  });
  return result;
}

}  // namespace swiftlet
