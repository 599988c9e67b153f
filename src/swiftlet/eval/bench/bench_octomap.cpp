// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/bench/benchmark_subject.hpp"

#if SWIFTLET_HAS_OCTOMAP

#include <octomap/octomap.h>

#include <algorithm>

#include "swiftlet/eval/bench/bench_points.hpp"
#include "swiftlet/eval/bench/octomap_keys_private.hpp"

namespace swiftlet::eval {
namespace {

class OctomapSubject final : public BenchmarkSubject {
 public:
  OctomapSubject(const MapperConfig& config, bool is_discretised)
      : range_(config.depth), is_discretised_(is_discretised), tree_(config.map.voxel_m) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    StageTimes times;
    StageTimer timer(times);
    octomap::Pointcloud cloud;
    cloud.reserve(frame.depth.raw.pixels().size());
    for_each_point(frame, range_,
                   [&](const Eigen::Vector3f& p) { cloud.push_back(p.x(), p.y(), p.z()); });
    timer.finish(Stage::kPreprocess);
    const Eigen::Vector3f o = frame.T_world_camera.translation().cast<float>();
    // No limit of range: the cloud keeps it by depth, as ours does. A limit by distance would cut
    // the rays at the image's edge.
    constexpr double kNoLimit = -1.0;
    constexpr bool kIsLazy = false;
    tree_.insertPointCloud(cloud, {o.x(), o.y(), o.z()}, kNoLimit, kIsLazy, is_discretised_);
    timer.finish(Stage::kIntegrate);
    return times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return tree_.memoryUsage(); }

  void read_claims(Claims& claims) const override {
    std::ranges::fill(claims.voxels(), Occupancy::kUnknown);
    const octomap::OcTreeKey first = key_of(claims.box().first), last = key_of(claims.box().last);
    for (auto leaf = tree_.begin_leafs_bbx(first, last), end = tree_.end_leafs_bbx(); leaf != end;
         ++leaf) {
      const Occupancy state = tree_.isNodeOccupied(*leaf) ? Occupancy::kOccupied : Occupancy::kFree;
      const int edge = 1 << (tree_.getTreeDepth() - leaf.getDepth());  // of a pruned node [voxels]
      const VoxelIndex corner = voxel_of(leaf.getIndexKey());
      for (int i = 0; i < edge * edge * edge; ++i) {
        const VoxelIndex v{corner.x + i % edge, corner.y + i / edge % edge,
                           corner.z + i / edge / edge};
        if (claims.contains(v)) claims.at(v) = state;
      }
    }
  }

 private:
  PreprocessOptions range_;
  bool is_discretised_;
  octomap::OcTree tree_;
};

}  // namespace

std::unique_ptr<BenchmarkSubject> make_octomap_subject(const MapperConfig& config,
                                                       bool is_discretised) {
  return std::make_unique<OctomapSubject>(config, is_discretised);
}

}  // namespace swiftlet::eval

#else

namespace swiftlet::eval {

std::unique_ptr<BenchmarkSubject> make_octomap_subject(const MapperConfig&, bool) {
  return nullptr;
}

}  // namespace swiftlet::eval

#endif
