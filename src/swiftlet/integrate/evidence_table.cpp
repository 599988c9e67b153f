// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/evidence_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

constexpr double kRowDepth_m = 0.02;  // rows stand for at least this much depth
constexpr std::size_t kRawValues = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};

std::int16_t quantised(double log_odds) {
  return static_cast<std::int16_t>(std::lrint(log_odds * EvidenceTable::kOne));
}

}  // namespace

void EvidenceTable::prepare(const StereoSensor& sensor, float unit_m, std::uint16_t farthest) {
  const Key key{unit_m, sensor.noise().sigma_m(1.0), sensor.model().options()};
  if (!(key == key_)) start_over(key, sensor.model());
  while (rows_.size() <= static_cast<std::size_t>(farthest >> shift_)) {
    rows_.emplace_back();
    fill_row(sensor, rows_.size() - 1);
  }
}

void EvidenceTable::start_over(const Key& key, const InverseSensorModel& model) {
  key_ = key;
  unit_m_ = key.unit_m;
  sigma_per_z2_ = static_cast<float>(key.sigma_per_z2);
  free_ = quantised(model.free_log_odds());
  for (shift_ = 0; unit_m_ * static_cast<float>(1 << shift_) < kRowDepth_m && shift_ < 12;)
    ++shift_;
  rows_.clear();
  rows_.reserve((kRawValues >> shift_) + 1);
}

void EvidenceTable::fill_row(const StereoSensor& sensor, std::size_t row) {
  const double middle = (static_cast<double>(row) + 0.5) * (1 << shift_);
  const double sigma_m = sensor.noise().sigma_m(double{unit_m_} * middle);
  for (std::size_t column = 0; column < kColumns; ++column) {
    const double d_sigma = (static_cast<double>(column) + 0.5) / kPerSigma - kInFrontSigma;
    rows_[row][column] = quantised(sensor.model().log_odds(d_sigma * sigma_m, sigma_m));
  }
  // A cell that holds the reading is at distance 0, which is in front.
  constexpr auto kAtReading = static_cast<std::size_t>(kPerSigma * kInFrontSigma);
  rows_[row][kAtReading] = quantised(sensor.model().log_odds(0.0, sigma_m));
}

}  // namespace swiftlet
