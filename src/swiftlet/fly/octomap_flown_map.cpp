// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/flown_map.hpp"

#if SWIFTLET_HAS_OCTOMAP

#include <octomap/octomap.h>

#include <utility>

#include "swiftlet/eval/bench/bench_points.hpp"
#include "swiftlet/eval/bench/octomap_keys_private.hpp"

namespace swiftlet {
namespace {

/// An octree with OctoMap's own sensor model, and a window of what it claims, kept up to date by
/// the keys that it says have changed.
class OctomapMap final : public FlownMap, private BlockArchive {
 public:
  OctomapMap(const MapperConfig& config, RollingMap window)
      : config_(config), tree_(config.map.voxel_m), window_(std::move(window)) {
    tree_.enableChangeDetection(true);
  }

  bool integrate(const Frame& frame) override {
    octomap::Pointcloud cloud;
    cloud.reserve(frame.depth.raw.pixels().size());
    eval::for_each_point(frame, config_.depth,
                         [&](const Eigen::Vector3f& p) { cloud.push_back(p.x(), p.y(), p.z()); });
    if (cloud.size() == 0) return false;
    const Eigen::Vector3f eye = frame.T_world_camera.translation().cast<float>();
    constexpr double kNoLimit = -1.0;  // the cloud keeps it by depth, as ours does
    constexpr bool kIsLazy = false, kIsDiscretised = true;  // the quicker way
    tree_.insertPointCloud(cloud, {eye.x(), eye.y(), eye.z()}, kNoLimit, kIsLazy, kIsDiscretised);
    window_.recentre(frame.T_world_camera.translation(), this);
    for (auto it = tree_.changedKeysBegin(); it != tree_.changedKeysEnd(); ++it) copy(it->first);
    tree_.resetChangeDetection();
    ++frames_;
    return true;
  }
  RollingMap& window() override { return window_; }
  std::uint64_t frame_count() const override { return frames_; }
  std::size_t known_voxels() const override {
    std::size_t voxels = 0;
    for (auto leaf = tree_.begin_leafs(), end = tree_.end_leafs(); leaf != end; ++leaf) {
      const std::size_t edge = std::size_t{1} << (tree_.getTreeDepth() - leaf.getDepth());
      voxels += edge * edge * edge;
    }
    return voxels;
  }

 private:
  [[nodiscard]] QuantizedLogOdds claim_of(const octomap::OcTreeKey& key) const {
    const octomap::OcTreeNode* node = tree_.search(key);
    if (node == nullptr) return kUnknownVoxel;
    return tree_.isNodeOccupied(node) ? kOccupiedVoxel : kFreeVoxel;
  }
  void copy(const octomap::OcTreeKey& key) {
    const VoxelIndex v = eval::voxel_of(key);
    if (!window_.window().contains(block_of(v))) return;
    window_.writable(block_of(v)).voxels[offset_in_block(v)] = claim_of(key);
  }

  // The tree remembers what leaves the window.
  void evict(const BlockIndex&, const VoxelBlock&, std::uint64_t) override {}
  bool restore(const BlockIndex& index, VoxelBlock& out) override {
    bool is_known = false;
    for (int i = 0; i < kBlockVoxels; ++i) {
      out.voxels[static_cast<std::size_t>(i)] = claim_of(eval::key_of(voxel_at(index, i)));
      is_known |= out.voxels[static_cast<std::size_t>(i)] != kUnknownVoxel;
    }
    return is_known;
  }
  void expect_around(const BlockWindow&) override {}

  MapperConfig config_;
  octomap::OcTree tree_;
  RollingMap window_;
  std::uint64_t frames_ = 0;
};

}  // namespace

Expected<FlownMapPtr> make_octomap_map(const MapperConfig& config) {
  auto window = RollingMap::create(config.map);
  if (!window) return forward_error(std::move(window));
  return std::make_unique<OctomapMap>(config, std::move(*window));
}

}  // namespace swiftlet

#else

namespace swiftlet {

Expected<FlownMapPtr> make_octomap_map(const MapperConfig& /*config*/) {
  return fail(ErrorCode::kUnsupported, "octomap", "this build has no OctoMap",
              "install liboctomap-dev and configure with -DSWIFTLET_WITH_OCTOMAP=ON");
}

}  // namespace swiftlet

#endif
