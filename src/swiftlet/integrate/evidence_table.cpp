// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/evidence_table.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

constexpr double kRowDepth_m = 0.1;  // rows stand for at least this much depth
constexpr std::size_t kRawValues = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};
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

}  // namespace

void EvidenceTable::prepare(const StereoSensor& sensor, float unit_m, std::uint16_t farthest) {
  const Key key{unit_m, sensor.noise().sigma_m(1.0), sensor.model().options()};
  if (!(key == key_)) start_over(key, sensor.model());
  const std::size_t rows = static_cast<std::size_t>(farthest >> shift_) + 1;
  while (rise_.size() < rows * kRowLength) add_row(sensor);
}

void EvidenceTable::start_over(const Key& key, const InverseSensorModel& model) {
  key_ = key;
  unit_m_ = key.unit_m;
  sigma_per_z2_ = static_cast<float>(key.sigma_per_z2);
  free_ = static_cast<float>(model.free_log_odds());
  for (shift_ = 0; unit_m_ * static_cast<float>(1 << shift_) < kRowDepth_m && shift_ < 12;)
    ++shift_;
  const std::size_t rows = (kRawValues >> shift_) + 1;
  for (std::vector<float>* part : {&rise_, &fall_}) {
    part->clear();
    part->reserve(rows * kRowLength);
  }
}

void EvidenceTable::add_row(const StereoSensor& sensor) {
  const std::size_t row = rise_.size() / kRowLength;
  const double sigma_m =
      sensor.noise().sigma_m(double{unit_m_} * (static_cast<double>(row) + 0.5) * (1 << shift_));
  const ModelCurve curve(sensor.model(), sigma_m);
  for (int c = 0; c < kClasses; ++c) {
    const double narrow = std::max(kNarrowest, static_cast<double>(c) / (kClasses - 1));
    const double scatter = std::sqrt(1.0 - std::min(1.0, narrow * narrow));
    for (int column = 0; column < kColumns; ++column) {
      const double d = static_cast<double>(column - kZero) / double{kPerDeviation};
      double rise = 0.0, fall = 0.0;
      for (const double draw : normal_draws()) {
        const double d_sigma = (d + scatter * draw) / narrow;
        rise += curve.at(std::min(d_sigma, 0.0));
        fall += curve.at(std::max(d_sigma, 0.0)) - curve.peak();
      }
      const auto draws = static_cast<double>(normal_draws().size());
      rise_.push_back(static_cast<float>(rise / draws));
      fall_.push_back(static_cast<float>(fall / draws));
    }
  }
}

}  // namespace swiftlet
