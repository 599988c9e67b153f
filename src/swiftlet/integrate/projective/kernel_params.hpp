// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>

#include "swiftlet/integrate/projective/cube_view.hpp"
#include "swiftlet/integrate/step_rounding.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// What the kernels know of one posed depth image. Lengths in metres, images in pixels.
struct ViewParams {
  std::array<Float3, 3> world_axis;  ///< of the world, in camera axes
  float fx, fy;
  float u_offset, v_offset;  ///< principal point + 0.5: floor() of a place is its pixel
  float width, height;
  float voxel_m;
  float unit_m;  ///< of a reading
};

[[nodiscard]] inline ViewParams view_params(const CubeView& view, float unit_m) {
  return {.world_axis = view.world_axis(),
          .fx = view.fx(),
          .fy = view.fy(),
          .u_offset = view.cx() + 0.5F,
          .v_offset = view.cy() + 0.5F,
          .width = static_cast<float>(view.width()),
          .height = static_cast<float>(view.height()),
          .voxel_m = view.voxel_m(),
          .unit_m = unit_m};
}

/// Where the evidence of a measurement model ends, and how much a voxel gets that rays pass.
///
/// A cube of voxels that lies farther than a reading's depth + reach_sigma deviations + hidden_m is
/// hidden by it; one nearer than its depth - in_front_sigma deviations - passed_m is passed, and
/// with clear_m instead of passed_m so clearly that its voxels get clear_log_odds at once.
struct ModelParams {
  float hidden_m, passed_m, clear_m;
  float reach_sigma, in_front_sigma;
  float free_log_odds, clear_log_odds;  ///< of a whole observation
  const float* table = nullptr;         ///< of the model's own kernels, if they want one
};

/// What the kernels know of one frame, its sensor and its model.
struct KernelParams : ViewParams {
  ModelParams model;
  float sigma_per_z2;        ///< deviation of a reading over the square of its depth [1/m]
  float per_sigma;           ///< 1 / sigma_per_z2
  float steps_per_log_odds;  ///< FixedSteps
};

[[nodiscard]] inline KernelParams kernel_params(const ViewParams& view, const ModelParams& model,
                                                const StereoSensor& sensor,
                                                double logodds_per_step) {
  const auto sigma_per_z2 = static_cast<float>(sensor.noise().sigma_m(1.0));
  return {view, model, sigma_per_z2, 1.0F / sigma_per_z2,
          static_cast<float>(kOneStep / logodds_per_step)};
}

}  // namespace swiftlet
