// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "swiftlet/query/explore/frontier_map.hpp"

namespace swiftlet {

/// A piece of the frontier that can be looked at as one.
struct FrontierCluster {
  std::size_t first_voxel = 0;                           ///< its voxels in FrontierClusters::voxels
  std::size_t voxel_count = 0;                           ///< how many they are
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< [world]
  /// Mean direction into the unknown, of length 1; 0 where the directions cancel out. [world]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// All pieces of a frontier.
struct FrontierClusters {
  std::vector<VoxelIndex> voxels;         ///< cluster by cluster
  std::vector<FrontierCluster> clusters;  ///< in no order

  /// The voxels of one cluster. REQUIRES: it is one of `clusters`.
  [[nodiscard]] std::span<const VoxelIndex> voxels_of(const FrontierCluster& cluster) const {
    return std::span(voxels).subspan(cluster.first_voxel, cluster.voxel_count);
  }
};

/// How a frontier is cut into pieces.
struct ClusterOptions {
  double max_extent_m = 2.0;   ///< a cluster's box has no longer edge, so that one view may see it
  std::size_t min_voxels = 4;  ///< smaller ones are left out: holes in walls, noise
};

/// Splits the frontier into clusters whose voxels touch each other by face, edge or corner. The
/// same frontier gives the same clusters, in the same order. Cost: O(blocks of the window + voxels
/// of the frontier).
[[nodiscard]] FrontierClusters cluster_frontier(const FrontierMap& frontier,
                                                const ClusterOptions& options = {});

}  // namespace swiftlet
