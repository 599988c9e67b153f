// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cmath>

#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/sensor/inverse_sensor_model.hpp"
#include "swiftlet/sensor/stereo_noise.hpp"

namespace swiftlet {

/// What is known of the instrument besides its intrinsics.
struct SensorOptions {
  double baseline_m = 0.05;   ///< D435
  double subpixel_px = 0.08;  ///< s of StereoNoise
  InverseSensorModel::Options model;
};

[[nodiscard]] inline StereoNoise stereo_noise(const PinholeIntrinsics& intrinsics,
                                              const SensorOptions& options) {
  return {intrinsics.fx(), options.baseline_m, options.subpixel_px};
}

/// A stereo depth camera as the map sees it: how much one reading says about one voxel.
class StereoSensor {
 public:
  StereoSensor(const PinholeIntrinsics& intrinsics, const SensorOptions& options, double voxel_m,
               int ratio)
      : noise_(stereo_noise(intrinsics, options)),
        model_(options.model),
        half_voxel_m_(0.5 * voxel_m),
        weight_per_z2_(ratio * ratio / (intrinsics.fx() * intrinsics.fy() * voxel_m * voxel_m)) {}

  [[nodiscard]] const StereoNoise& noise() const { return noise_; }
  [[nodiscard]] const InverseSensorModel& model() const { return model_; }

  /// Distance weighting DW = z^2 n^2 / density^2, density = f c: undoes the fall of pixel density
  /// with distance, so that a voxel fully covered by rays gets one observation a frame (method 6,
  /// eq. 3.21). z is the voxel's depth [m].
  [[nodiscard]] double weight(double z_m) const { return z_m * z_m * weight_per_z2_; }

  /// Log-odds that a reading at depth z [m] gives a voxel whose centre lies at depth z_voxel [m].
  ///
  /// A voxel is no point: it counts as the slice of half a voxel in front of and behind its centre,
  /// and d of the model is the distance from the reading to that slice. Else a surface seen with a
  /// sigma of millimetres would fall between the centres of 20 cm voxels and be in none of them.
  [[nodiscard]] double log_odds(double z_voxel_m, double z_reading_m, double sigma_m) const {
    const double offset_m = z_voxel_m - z_reading_m;
    const bool is_clearly_in_front =
        offset_m < -half_voxel_m_ - InverseSensorModel::kClearlyInFrontSigma * sigma_m;
    if (is_clearly_in_front) return model_.free_log_odds();  // most voxels of a ray
    const double gap_m = std::max(0.0, std::abs(offset_m) - half_voxel_m_);
    return model_.log_odds(std::copysign(gap_m, offset_m), sigma_m);
  }

 private:
  StereoNoise noise_;
  InverseSensorModel model_;
  double half_voxel_m_;
  double weight_per_z2_;
};

}  // namespace swiftlet
