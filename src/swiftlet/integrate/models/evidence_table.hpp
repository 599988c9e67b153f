// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/integrate/image/depth_mean_kernels.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// The inverse sensor model, tabulated: its mean over readings that scatter.
///
/// A voxel counts as a slice of depth (StereoSensor), so what a reading says about it rises from
/// "free" to the model's peak as the slice's far side comes to the reading, and falls to nothing as
/// its near side leaves the reading behind. Readings of mean m and scatter s, each of deviation
/// sigma, say the mean of that over a normal distribution: a function of the distances d of the
/// slice's two sides from m, over t with t^2 = sigma^2 + s^2, of sigma / t, and of the depth m.
///
/// Row: depth of the readings; class: sigma / t from 0 to 1; column: the sum of both d / t, each
/// within +- kReach, so that the plateau between rise and fall takes no columns.
class EvidenceTable {
 public:
  static constexpr int kClasses = 8;
  static constexpr float kReach = 5.0F;          ///< t: farther than this the model is flat
  static constexpr float kPerDeviation = 12.0F;  ///< columns a t
  static constexpr int kColumns = 256;
  static constexpr int kMiddle = 128;  ///< the column of 0: the slice's centre is at m
  /// L is within 1e-4 of the model's free_log_odds() so many sigma in front of a reading.
  static constexpr float kInFrontSigma = 5.0F;
  /// Behind z_t + so many sigma a reading says nothing.
  static constexpr auto kReachSigma = static_cast<float>(InverseSensorModel::kBandSigma);
  /// The row of a depth is that of its code: 16 rows for twice the depth.
  static constexpr int kRowShift = 8;
  static constexpr int kRows = DepthMeanTiles::kCodes >> kRowShift;

  /// Ready for readings up to a depth [m]. Allocates on the first call; fills rows when a frame
  /// sees farther than any before, and all again when the sensor has changed.
  void prepare(const StereoSensor& sensor, float voxel_m, float farthest_m);

  /// Log-odds [((depth_code >> kRowShift) * kClasses + class) * kColumns + column].
  [[nodiscard]] const float* log_odds() const { return log_odds_.data(); }
  [[nodiscard]] std::size_t memory_bytes() const { return log_odds_.capacity() * sizeof(float); }

 private:
  struct Key {
    float voxel_m = 0.0F;
    double sigma_per_z2 = 0.0;
    InverseSensorModel::Options model;
    friend bool operator==(const Key&, const Key&) = default;
  };
  void fill_row(int row, const StereoSensor& sensor);

  Key key_;
  int first_row_ = kRows;  // rows from here on, which are nearer, are filled
  std::vector<float> log_odds_;
};

}  // namespace swiftlet
