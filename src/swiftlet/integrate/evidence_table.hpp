// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// The inverse sensor model, tabulated: its mean over readings that scatter.
///
/// A cell counts as a slice of depth (StereoSensor), so what a reading says about it is a sum of
/// two parts: one that rises from "free" to the model's peak as the slice's far side comes to the
/// reading, and one that takes it back as its near side leaves the reading behind:
///   L(gap) = rise(z_far - z_reading) + fall(z_near - z_reading)
///   rise(d) = L(min(d, 0)), fall(d) = L(max(d, 0)) - L(0)
/// Readings of mean m and scatter s, each of deviation sigma, say the mean of that over a normal
/// distribution, a function of d / t with t^2 = sigma^2 + s^2, of sigma / t, and of the depth m.
///
/// Row: depth of the readings; class: sigma / t from 0 to 1; column: d / t; then rise and fall.
class EvidenceTable {
 public:
  static constexpr int kClasses = 8;
  static constexpr float kPerDeviation = 12.0F;  ///< columns
  static constexpr int kZero = 62;               ///< column of d = 0
  static constexpr int kColumns = 125;           ///< the first and last stand for all beyond
  /// L is within 1e-4 of free_log_odds() so many sigma in front of a reading.
  static constexpr float kInFrontSigma = 5.0F;
  /// Behind z_t + so many sigma a reading says nothing.
  static constexpr auto kReachSigma = static_cast<float>(InverseSensorModel::kBandSigma);

  /// Ready for readings 1 .. farthest of a frame. Allocates on the first call and when the sensor
  /// has changed.
  void prepare(const StereoSensor& sensor, float unit_m, std::uint16_t farthest);

  /// Log-odds [((raw >> row_shift()) * kClasses + class) * kColumns + column].
  [[nodiscard]] const float* rise() const { return rise_.data(); }
  [[nodiscard]] const float* fall() const { return fall_.data(); }
  [[nodiscard]] int row_shift() const { return shift_; }
  [[nodiscard]] float sigma_per_z2() const { return sigma_per_z2_; }
  [[nodiscard]] float unit_m() const { return unit_m_; }
  [[nodiscard]] float free_log_odds() const { return free_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return (rise_.capacity() + fall_.capacity()) * sizeof(float);
  }

 private:
  struct Key {
    float unit_m = 0.0F;
    double sigma_per_z2 = 0.0;
    InverseSensorModel::Options model;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static constexpr std::size_t kRowLength = std::size_t{kClasses} * kColumns;

  void start_over(const Key& key, const InverseSensorModel& model);
  void add_row(const StereoSensor& sensor);

  Key key_;
  float unit_m_ = 0.0F;
  float sigma_per_z2_ = 0.0F;
  float free_ = 0.0F;
  int shift_ = 0;
  std::vector<float> rise_, fall_;
};

}  // namespace swiftlet
