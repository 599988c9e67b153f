// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/models/evidence_table.hpp"

#include <array>
#include <bit>
#include <cmath>

namespace swiftlet {
namespace {

constexpr double kNarrowest = 1.0 / 32;  // sigma / t of class 0

/// The model of one depth, at distances in units of sigma.
class ModelCurve {
 public:
  ModelCurve(const InverseSensorModel& model, double sigma_m) {
    for (int i = 0; i < kPoints; ++i)
      log_odds_[static_cast<std::size_t>(i)] =
          model.log_odds((i - kPeak) * sigma_m / kPerSigma, sigma_m);
    // At the end of the band the model jumps to 0.
    log_odds_.back() = 0.0;
  }
  [[nodiscard]] double peak() const { return log_odds_[kPeak]; }
  [[nodiscard]] double at(double d_sigma) const {
    const double place = std::clamp(d_sigma * kPerSigma + kPeak, 0.0, double{kPoints - 1});
    const auto i = std::min(static_cast<std::size_t>(place), std::size_t{kPoints - 2});
    const double part = place - static_cast<double>(i);
    return (1.0 - part) * log_odds_[i] + part * log_odds_[i + 1];
  }

 private:
  static constexpr int kPerSigma = 32, kPeak = 8 * kPerSigma;  // 8 sigma in front, 3 behind
  static constexpr int kPoints = kPeak + 3 * kPerSigma + 2;
  std::array<double, kPoints> log_odds_;
};

/// The normal distribution, as the middles of 24 equally likely parts.
const std::array<double, 24>& normal_draws() {
  static const std::array<double, 24> kDraws = [] {
    std::array<double, 24> draws{};
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const double wanted = (static_cast<double>(i) + 0.5) / static_cast<double>(draws.size());
      double low = -8.0, high = 8.0;
      for (int step = 0; step < 50; ++step) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < wanted ? low : high) = middle;
      }
      draws[i] = low;
    }
    return draws;
  }();
  return kDraws;
}

/// From the slice's centre to the readings' mean [t], where the distances of its two sides, half
/// [t] to either side and each within +- kReach, sum up to y.
double centre_at(double y, double half) {
  constexpr double kReach = EvidenceTable::kReach;
  if (std::abs(y) <= 2.0 * (kReach - half)) return 0.5 * y;
  return y == 0.0 ? 0.0 : std::copysign(std::abs(y) - kReach + half, y);
}

double depth_of_row(int row) {
  const int code = (row << EvidenceTable::kRowShift) + (1 << (EvidenceTable::kRowShift - 1));
  return 1.0 / double{std::bit_cast<float>((code + DepthMeanTiles::kFirstCode)
                                           << DepthMeanTiles::kCodeShift)};
}

}  // namespace

void EvidenceTable::prepare(const StereoSensor& sensor, float voxel_m, float farthest_m) {
  const Key key{voxel_m, sensor.noise().sigma_m(1.0), sensor.model().options()};
  if (!(key == key_)) {
    key_ = key;
    first_row_ = kRows;
    log_odds_.resize(std::size_t{kRows} * kClasses * kColumns);
  }
  const int farthest_row = depth_code(farthest_m) >> kRowShift;
  while (first_row_ > farthest_row) fill_row(--first_row_, sensor);
}

void EvidenceTable::fill_row(int row, const StereoSensor& sensor) {
  const double sigma_m = sensor.noise().sigma_m(depth_of_row(row));
  const double half_sigma = 0.5 * double{key_.voxel_m} / sigma_m;
  const ModelCurve curve(sensor.model(), sigma_m);
  const auto first = static_cast<std::size_t>(row) * kClasses * kColumns;
  for (int c = 0; c < kClasses; ++c) {
    const double narrow = std::max(kNarrowest, static_cast<double>(c) / (kClasses - 1));
    const double scatter = std::sqrt(1.0 - std::min(1.0, narrow * narrow));
    for (int column = 0; column < kColumns; ++column) {
      const double y = static_cast<double>(column - kMiddle) / double{kPerDeviation};
      const double centre = centre_at(y, half_sigma * narrow);
      double sum = 0.0;
      for (const double draw : normal_draws()) {
        const double d_sigma = (centre + scatter * draw) / narrow;
        sum += curve.at(std::min(d_sigma + half_sigma, 0.0)) +
               curve.at(std::max(d_sigma - half_sigma, 0.0)) - curve.peak();
      }
      log_odds_[first + static_cast<std::size_t>(c * kColumns + column)] =
          static_cast<float>(sum / static_cast<double>(normal_draws().size()));
    }
  }
}

}  // namespace swiftlet
