// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/integrate/rays/ray_method.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet::test {

/// How two maps of the same frames compare, over the voxels that enough rays crossed.
struct Agreement {
  std::size_t voxels = 0;
  std::size_t same_class = 0;
  std::size_t clear_voxels = 0;  ///< of these, not within one step of a threshold in either map
  std::size_t clear_same_class = 0;
  double sum_difference = 0.0;  ///< in steps

  [[nodiscard]] double class_share() const { return share(same_class, voxels); }
  [[nodiscard]] double clear_class_share() const { return share(clear_same_class, clear_voxels); }
  [[nodiscard]] double mean_difference() const {
    return sum_difference / static_cast<double>(voxels);
  }
  [[nodiscard]] std::string text() const {
    return fmt::format("{} voxels: same class {:.3f} %, {:.3f} % off the thresholds, |diff| {:.3f}",
                       voxels, 100 * class_share(), 100 * clear_class_share(), mean_difference());
  }

  void add(QuantizedLogOdds a, QuantizedLogOdds b) {
    constexpr OccupancyThresholds thresholds;
    const auto is_near = [&](QuantizedLogOdds voxel) {
      return std::abs(2 * (voxel - thresholds.free_below) + 1) <= 3 ||
             std::abs(2 * (voxel - thresholds.occupied_from) + 1) <= 3;
    };
    const bool is_same = thresholds.classify(a) == thresholds.classify(b);
    ++voxels;
    same_class += is_same ? 1 : 0;
    sum_difference += std::abs(a - b);
    if (is_near(a) || is_near(b)) return;
    ++clear_voxels;
    clear_same_class += is_same ? 1 : 0;
  }

 private:
  static double share(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  }
};

/// Feeds the same frames to two integrators, in windows that do not move, and counts the rays.
class AgreementCheck {
 public:
  AgreementCheck(double voxel_m, const Eigen::Vector3d& size_m, const Eigen::Vector3d& middle_m,
                 double max_range_m, double baseline_m = 0.05,
                 std::string_view model = "inverse_sensor_model")
      : candidate_map_(new_map(voxel_m, size_m, middle_m)),
        reference_map_(new_map(voxel_m, size_m, middle_m)),
        candidate_(*make_integrator({.integrator = "projective"})),
        reference_(*make_integrator({.integrator = "rays"})),
        candidate_model_(find_measurement_model(model)->make()),
        reference_model_(find_measurement_model(model)->make()),
        preprocessor_(*Preprocessor::create({.max_range_m = max_range_m, .downsample = 1})),
        options_{.baseline_m = baseline_m, .model = {}},
        trace_(find_ray_method("voxel_traversal")->trace),
        box_(voxel_box(reference_map_.window())),
        observations_(reference_map_.window().block_count() * kBlockVoxels) {}

  void add(const Frame& frame) {
    const PreprocessedDepth& depth = preprocessor_.clean(frame.depth, frame.intrinsics, 0.004);
    const StereoSensor sensor(frame.intrinsics, options_, candidate_map_.voxel_m(), 1);
    pyramid_.build(depth.raw);
    const DepthView view{depth, pyramid_, frame.intrinsics, frame.T_world_camera, frames_++};
    const auto a = candidate_->integrate(view, sensor, *candidate_model_, candidate_map_);
    const auto b = reference_->integrate(view, sensor, *reference_model_, reference_map_);
    EXPECT_EQ(a.readings, b.readings);
    count_rays(view, sensor);
  }

  /// Over the voxels that rays worth at least half an observation crossed, in all frames together.
  [[nodiscard]] Agreement result() const {
    Agreement agreement;
    for (std::int32_t z = box_.first.z; z <= box_.last.z; ++z) {
      for (std::int32_t y = box_.first.y; y <= box_.last.y; ++y) {
        for (std::int32_t x = box_.first.x; x <= box_.last.x; ++x) {
          if (observations_[place({x, y, z})] < 0.5F) continue;
          agreement.add(candidate_map_.log_odds({x, y, z}), reference_map_.log_odds({x, y, z}));
        }
      }
    }
    return agreement;
  }

  [[nodiscard]] const std::vector<float>& observations() const { return observations_; }
  [[nodiscard]] const RollingMap& candidate() const { return candidate_map_; }
  [[nodiscard]] const RollingMap& reference() const { return reference_map_; }

 private:
  static RollingMap new_map(double voxel_m, const Eigen::Vector3d& size_m,
                            const Eigen::Vector3d& middle_m) {
    auto map = RollingMap::create({voxel_m, size_m, {1e3, 1e3, 1e3}});
    map->recentre(middle_m, nullptr);
    return std::move(*map);
  }

  [[nodiscard]] std::size_t place(const VoxelIndex& v) const {
    const auto side = [](std::int32_t a, std::int32_t b) {
      return static_cast<std::size_t>(b - a);
    };
    const std::size_t nx = side(box_.first.x, box_.last.x) + 1;
    const std::size_t ny = side(box_.first.y, box_.last.y) + 1;
    return (side(box_.first.z, v.z) * ny + side(box_.first.y, v.y)) * nx + side(box_.first.x, v.x);
  }

  void count_rays(const DepthView& view, const StereoSensor& sensor) {
    const double voxel = reference_map_.voxel_m();
    const Eigen::Matrix3d R = view.T_world_camera.rotation().toRotationMatrix();
    const Eigen::Vector3d camera_m = view.T_world_camera.translation();
    voxels_.resize(max_voxels(box_));
    for (int v = 0; v < view.depth.raw.height(); ++v) {
      for (int u = 0; u < view.depth.raw.width(); ++u) {
        if (view.depth.raw.at(u, v) == 0) continue;
        const double z_m = double{view.depth.unit_m} * view.depth.raw.at(u, v);
        const double z_end_m = z_m + 3.0 * sensor.noise().sigma_m(z_m);
        const Eigen::Vector3d end_m = camera_m + R * view.intrinsics.back_project(u, v, z_end_m);
        const std::size_t n = trace_({camera_m / voxel, end_m / voxel}, box_, voxels_);
        for (std::size_t i = 0; i < n; ++i) {
          const double z_voxel_m = R.col(2).dot(centre_of(voxels_[i], voxel) - camera_m);
          if (z_voxel_m > 0.0)
            observations_[place(voxels_[i])] += static_cast<float>(sensor.weight(z_voxel_m));
        }
      }
    }
  }

  RollingMap candidate_map_, reference_map_;
  std::unique_ptr<Integrator> candidate_, reference_;
  MeasurementModelPtr candidate_model_, reference_model_;
  Preprocessor preprocessor_;
  DepthRangePyramid pyramid_;
  SensorOptions options_;
  TraceRay trace_;
  VoxelBox box_;
  std::vector<float> observations_;  // of all frames: each ray counts DW
  std::vector<VoxelIndex> voxels_;
  std::uint64_t frames_ = 0;
};

/// What the projective integrator keeps today (docs/method.md). The aim is 99.5 % of the same
/// class, 99.9 % off the thresholds and 2 steps.
inline void expect_agreement(const Agreement& agreement) {
  SCOPED_TRACE(agreement.text());
  EXPECT_GT(agreement.voxels, 1000U);
  EXPECT_GE(agreement.class_share(), 0.97);
  EXPECT_GE(agreement.clear_class_share(), 0.98);
  EXPECT_LE(agreement.mean_difference(), 3.0);
}

}  // namespace swiftlet::test
