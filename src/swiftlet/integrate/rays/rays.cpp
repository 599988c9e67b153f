// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <vector>

#include "swiftlet/integrate/evidence_sums.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/rays/ray_in_view.hpp"
#include "swiftlet/integrate/rays/ray_method.hpp"

namespace swiftlet {
namespace {

/// The thesis's way (method 5 and 6): every reading is a ray from the camera through the voxel it
/// was measured in and on to where the model ends; each voxel on the way gets what the model says.
class RayIntegrator final : public Integrator {
 public:
  RayIntegrator(TraceRay trace, double logodds_per_step) : trace_(trace), sums_(logodds_per_step) {}

  [[nodiscard]] std::size_t memory_bytes() const override {
    return sums_.memory_bytes() + voxels_.capacity() * sizeof(VoxelIndex);
  }

 private:
  IntegrationTally fuse(const DepthView& view, const StereoSensor& /*sensor*/,
                        MeasurementModel& model, RollingMap& map) override {
    const VoxelBox box = voxel_box(map.window());
    voxels_.resize(max_voxels(box));
    sums_.begin(map.window());
    const RayGeometry geometry(view, map.voxel_m());

    IntegrationTally tally;
    const PreprocessedDepth& depth = view.depth;
    for (int v = 0; v < depth.raw.height(); ++v) {
      for (int u = 0; u < depth.raw.width(); ++u) {
        const std::uint16_t raw = depth.raw.at(u, v);
        if (raw == 0) continue;
        const Eigen::Vector3d direction = geometry.direction(depth.origin_of(u, v));
        add_reading({geometry, direction, double{depth.unit_m} * raw}, model, box);
        ++tally.readings;
      }
    }
    tally.voxels = sums_.apply(view.frame_number, map);
    tally.blocks = sums_.touched_blocks();
    return tally;
  }

  void add_reading(const RayInView& ray, const MeasurementModel& model, const VoxelBox& box) {
    const Eigen::Vector3d& from = ray.geometry.origin;
    const double z_end_m = model.ray_end_m(ray.z_m);
    const std::size_t n = trace_({from, from + z_end_m * ray.direction}, box, voxels_);
    model.add_ray(ray, {voxels_.data(), n}, sums_);
  }

  TraceRay trace_;
  EvidenceSums sums_;
  std::vector<VoxelIndex> voxels_;  // of one ray
};

}  // namespace

Expected<std::unique_ptr<Integrator>> make_rays(const IntegrateOptions& options) {
  auto method = find_ray_method(options.ray_method);
  if (!method) return forward_error(std::move(method));
  return std::make_unique<RayIntegrator>(method->trace, options.logodds_per_step);
}

}  // namespace swiftlet
