// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/models/evidence_table.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "support/synthetic.hpp"

namespace swiftlet {
namespace {

constexpr float kTableVoxel_m = 0.1F, kTableFarthest_m = 10.0F;

StereoSensor table_sensor(double subpixel_px = 0.08) {
  return {test::small_camera(640, 480), {.subpixel_px = subpixel_px, .model = {}}, 0.1, 1};
}

/// Depth [m] in the middle of a row.
double row_depth_m(int row) {
  const int code = (row << EvidenceTable::kRowShift) + (1 << (EvidenceTable::kRowShift - 1));
  return 1.0 / double{std::bit_cast<float>((code + DepthMeanTiles::kFirstCode)
                                           << DepthMeanTiles::kCodeShift)};
}

int row_of_depth(float depth_m) { return depth_code(depth_m) >> EvidenceTable::kRowShift; }

double entry(const EvidenceTable& table, int row, int of_class, int column) {
  return double{table.log_odds()[static_cast<std::size_t>(
      (row * EvidenceTable::kClasses + of_class) * EvidenceTable::kColumns + column)]};
}

/// Mean over readings that scatter by s about m, by a fine sum over their normal distribution.
double mean_over_scatter(const StereoSensor& sensor, double z_voxel_m, double m, double s_m,
                         double sigma_m) {
  if (s_m == 0.0) return sensor.log_odds(z_voxel_m, m, sigma_m);
  constexpr int kParts = 4000;
  constexpr double kEnd = 6.0;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double x = kEnd * (2.0 * (i + 0.5) / kParts - 1.0), weight = std::exp(-0.5 * x * x);
    sum += weight * sensor.log_odds(z_voxel_m, m - x * s_m, sigma_m);
    weights += weight;
  }
  return sum / weights;
}

// The table takes 24 equally likely readings for the distribution: at the model's rise and at its
// end one of them may fall on the other side, half a 24th each; on the mean that averages out.
// Readings that do not scatter fall on one side all: there the place of the jump itself is left
// out.
TEST(EvidenceTable, is_the_mean_of_the_inverse_sensor_model_over_readings_that_scatter) {
  const StereoSensor sensor = table_sensor();
  EvidenceTable table;
  table.prepare(sensor, kTableVoxel_m, kTableFarthest_m);
  double sum_off = 0.0;
  int count = 0;
  for (const float depth_m : {0.6F, 1.5F, 4.0F, 9.0F}) {
    const int row = row_of_depth(depth_m);
    const double m = row_depth_m(row), sigma_m = sensor.noise().sigma_m(m);
    const double jump = sensor.model().log_odds(0.0, sigma_m) - sensor.model().free_log_odds();
    for (int c = 1; c < EvidenceTable::kClasses; ++c) {
      const double narrow = static_cast<double>(c) / (EvidenceTable::kClasses - 1),
                   t_m = sigma_m / narrow;
      const double scatter_m = std::sqrt(std::max(0.0, t_m * t_m - sigma_m * sigma_m));
      const double half = 0.5 * double{kTableVoxel_m} / t_m;
      for (int column = 1; column < EvidenceTable::kColumns; column += 3) {
        const double y = (column - EvidenceTable::kMiddle) / double{EvidenceTable::kPerDeviation};
        // Both sides of the slice are within reach: y is their sum, so the centre is half of it.
        if (std::abs(y) > 2.0 * (double{EvidenceTable::kReach} - half)) continue;
        const double near_sigma = (0.5 * y - half) / narrow;
        const bool is_at_jump = std::abs(near_sigma - InverseSensorModel::kBandSigma) < 0.1;
        if (c == EvidenceTable::kClasses - 1 && is_at_jump) continue;
        const double wanted = mean_over_scatter(sensor, m + 0.5 * y * t_m, m, scatter_m, sigma_m);
        const double off = std::abs(entry(table, row, c, column) - wanted);
        EXPECT_LE(off, jump / 24.0) << depth_m << " m, class " << c << ", column " << column;
        sum_off += off;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 500);
  EXPECT_LE(sum_off / count, 0.02);
}

TEST(EvidenceTable, goes_from_free_before_the_readings_to_nothing_behind_them) {
  const StereoSensor sensor = table_sensor();
  EvidenceTable table;
  table.prepare(sensor, kTableVoxel_m, kTableFarthest_m);
  for (int row = row_of_depth(kTableFarthest_m); row < EvidenceTable::kRows; ++row) {
    // Nearer than cameras read, sigma is so small that the model's peak is high: five sigma before
    // it more of that is left.
    const double left = row <= row_of_depth(0.2F) ? 0.02 : 0.04;
    for (int c = 1; c < EvidenceTable::kClasses; ++c) {
      EXPECT_NEAR(entry(table, row, c, 0), sensor.model().free_log_odds(), left) << row;
      EXPECT_NEAR(entry(table, row, c, EvidenceTable::kColumns - 1), 0.0, left) << row;
    }
  }
}

// What a frame that sees farther adds, and what another sensor makes anew, is what a new table has.
TEST(EvidenceTable, is_the_same_however_it_was_filled) {
  const auto entries = [](const EvidenceTable& table) {
    const int first =
        row_of_depth(kTableFarthest_m) * EvidenceTable::kClasses * EvidenceTable::kColumns;
    const int end = EvidenceTable::kRows * EvidenceTable::kClasses * EvidenceTable::kColumns;
    return std::vector<float>(table.log_odds() + first, table.log_odds() + end);
  };
  EvidenceTable at_once, bit_by_bit;
  at_once.prepare(table_sensor(), kTableVoxel_m, kTableFarthest_m);
  bit_by_bit.prepare(table_sensor(0.2), kTableVoxel_m, 2.0F);
  for (const float farthest_m : {1.0F, 5.0F, 3.0F, kTableFarthest_m})
    bit_by_bit.prepare(table_sensor(), kTableVoxel_m, farthest_m);
  EXPECT_EQ(entries(bit_by_bit), entries(at_once));
}

}  // namespace
}  // namespace swiftlet
