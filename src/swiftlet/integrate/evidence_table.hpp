// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/integrate/depth_pyramid.hpp"
#include "swiftlet/integrate/reading_sums.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// The inverse sensor model, tabulated: one row for readings of about the same depth (and so of the
/// same sigma), one column for the distance of a cell from the reading in units of sigma.
///
/// Values are log-odds * 2^12 as integers: sums of them do not depend on their order. Rows are
/// filled when a frame first reaches their depth.
class EvidenceTable {
 public:
  static constexpr double kOne = 4096.0;
  static constexpr float kInFrontSigma = 5.0F;  ///< L is within 1e-4 of free_log_odds() here
  static constexpr float kPerSigma = 32.0F;
  static constexpr int kColumns = 256;  ///< kInFrontSigma in front to kBandSigma behind

  /// Readers of the readings 1 .. farthest of a frame. Allocates on the first call and when the
  /// sensor has changed.
  void prepare(const StereoSensor& sensor, float unit_m, std::uint16_t farthest);

  /// Depth [m] of a reading.
  [[nodiscard]] float depth_m(std::uint16_t raw) const { return unit_m_ * static_cast<float>(raw); }
  /// Behind this depth [m] a reading says nothing: z_t + 3 sigma. Grows with raw.
  [[nodiscard]] float reach_m(std::uint16_t raw) const {
    const float z = depth_m(raw);
    return z + static_cast<float>(InverseSensorModel::kBandSigma) * sigma_per_z2_ * z * z;
  }
  /// Up to this depth [m] every reading of a range says "free" and nothing else. Concave in the
  /// depth of the reading, so its smallest value is at an end of the range.
  [[nodiscard]] float clear_m(const DepthRange& range) const {
    return std::min(clear_m(range.nearest), clear_m(range.farthest));
  }

  /// The part of a query that describes readings.
  void describe(ReadingQuery& query) const;
  [[nodiscard]] std::int32_t free() const { return free_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return rows_.capacity() * (sizeof(Row) + sizeof(float));
  }

 private:
  /// Column 0 is all that lies in front of the tabulated ones, the last all that lies behind.
  using Row = std::array<std::int32_t, kColumns + 2>;
  struct Key {
    float unit_m = 0.0F;
    double sigma_per_z2 = 0.0;
    InverseSensorModel::Options model;
    friend bool operator==(const Key&, const Key&) = default;
  };
  [[nodiscard]] float clear_m(std::uint16_t raw) const {
    const float z = depth_m(raw);
    return z - kInFrontSigma * sigma_per_z2_ * z * z;
  }
  void start_over(const Key& key, const InverseSensorModel& model);
  void fill_row(const StereoSensor& sensor, std::size_t row);

  Key key_;
  float unit_m_ = 0.0F;
  float sigma_per_z2_ = 0.0F;
  int shift_ = 0;  // raw >> shift_ is the row
  std::int32_t free_ = 0;
  std::int32_t at_reading_ = 0;  // the upper limit of the model
  float sure_z_m_ = 0.0F;        // up to here a reading reaches it
  std::vector<Row> rows_;
  std::vector<float> columns_per_m_;  // of each row: kPerSigma / sigma
};

}  // namespace swiftlet
