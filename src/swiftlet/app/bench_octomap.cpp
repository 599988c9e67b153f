// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/bench_contender.hpp"

#if SWIFTLET_HAS_OCTOMAP

#include <octomap/octomap.h>

#include "swiftlet/app/bench_points.hpp"

namespace swiftlet::app {
namespace {

class OctomapContender final : public Contender {
 public:
  OctomapContender(const MapperConfig& config, bool is_discretised)
      : range_(config.depth), is_discretised_(is_discretised), tree_(config.map.voxel_m) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    StageTimes times;
    StageTimer timer(times);
    octomap::Pointcloud cloud;
    cloud.reserve(frame.depth.raw.pixels().size());
    for_each_point(frame, range_,
                   [&](const Eigen::Vector3f& p) { cloud.push_back(p.x(), p.y(), p.z()); });
    timer.finish(Stage::kCondition);
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

 private:
  ConditionOptions range_;
  bool is_discretised_;
  octomap::OcTree tree_;
};

}  // namespace

std::unique_ptr<Contender> make_octomap_contender(const MapperConfig& config, bool is_discretised) {
  return std::make_unique<OctomapContender>(config, is_discretised);
}

}  // namespace swiftlet::app

#else

namespace swiftlet::app {

std::unique_ptr<Contender> make_octomap_contender(const MapperConfig&, bool) { return nullptr; }

}  // namespace swiftlet::app

#endif
