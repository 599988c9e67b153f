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

/// The voxels that belong to no cluster yet, by block.
class VoxelsLeft {
 public:
  explicit VoxelsLeft(const FrontierMap& frontier) {
    frontier.for_each_voxel([&](const VoxelIndex& v) { blocks_[block_of(v)][word(v)] |= bit(v); });
  }
  /// Takes a voxel out; false if it is not there.
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

/// Grows a box by a voxel, unless an edge would be longer than `most` voxels.
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

/// Moves all voxels that hang together with `seed` to the end of `voxels`.
void gather(const VoxelIndex& seed, std::int32_t most, VoxelsLeft& left,
            std::vector<VoxelIndex>& voxels) {
  VoxelBox box{seed, seed};
  std::size_t next = voxels.size();
  voxels.push_back(seed);
  for (; next < voxels.size(); ++next) {
    const VoxelIndex at = voxels[next];
    for (int i = 0; i < 27; ++i) {
      const VoxelIndex v = shifted(at, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1});
      VoxelBox larger = box;
      if (!try_include(larger, v, most) || !left.take(v)) continue;
      box = larger;
      voxels.push_back(v);
    }
  }
}

FrontierCluster describe(const FrontierMap& frontier, const std::vector<VoxelIndex>& voxels,
                         std::size_t first) {
  FrontierCluster cluster{first, voxels.size() - first};
  for (std::size_t i = first; i < voxels.size(); ++i) {
    cluster.centroid_m += centre_of(voxels[i], frontier.voxel_m());
    for (const VoxelIndex& face : kFaces) {
      if (frontier.is_unknown(shifted(voxels[i], face)))
        cluster.normal += Eigen::Vector3d(face.x, face.y, face.z);
    }
  }
  cluster.centroid_m /= static_cast<double>(cluster.voxel_count);
  // Whole numbers: they cancel out exactly or not at all.
  if (!cluster.normal.isZero(0.0)) cluster.normal.normalize();
  return cluster;
}

}  // namespace

FrontierClusters cluster_frontier(const FrontierMap& frontier, const ClusterOptions& options) {
  FrontierClusters result;
  VoxelsLeft left(frontier);
  const double most = std::clamp(std::floor(options.max_extent_m / frontier.voxel_m()), 1.0, 1e6);
  frontier.for_each_voxel([&](const VoxelIndex& seed) {
    if (!left.take(seed)) return;
    const std::size_t first = result.voxels.size();
    gather(seed, static_cast<std::int32_t>(most), left, result.voxels);
    if (result.voxels.size() - first < options.min_voxels) {
      result.voxels.resize(first);
    } else {
      result.clusters.push_back(describe(frontier, result.voxels, first));
    }
  });
  return result;
}

}  // namespace swiftlet
