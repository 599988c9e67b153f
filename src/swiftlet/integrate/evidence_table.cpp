// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/evidence_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace swiftlet {
namespace {

constexpr double kRowDepth_m = 0.02;  // rows stand for at least this much depth
constexpr std::size_t kRawValues = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};

std::int32_t quantised(double log_odds) {
  return static_cast<std::int32_t>(std::lrint(log_odds * EvidenceTable::kOne));
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
  // p reaches p_max at the reading while k / (sigma sqrt(2 pi)) >= p_max - 0.5.
  const InverseSensorModel::Options& o = key.model;
  const double sigma_m = o.importance_m / (std::sqrt(2.0 * std::numbers::pi) * (o.p_max - 0.5));
  sure_z_m_ = static_cast<float>(std::sqrt(sigma_m / key.sigma_per_z2));
  at_reading_ = quantised(model.log_odds(0.0, 0.5 * sigma_m));
  for (shift_ = 0; unit_m_ * static_cast<float>(1 << shift_) < kRowDepth_m && shift_ < 12;)
    ++shift_;
  rows_.clear();
  rows_.reserve((kRawValues >> shift_) + 1);
  columns_per_m_.assign((kRawValues >> shift_) + 1, 0.0F);
}

void EvidenceTable::fill_row(const StereoSensor& sensor, std::size_t row) {
  const double middle = (static_cast<double>(row) + 0.5) * (1 << shift_);
  const double sigma_m = sensor.noise().sigma_m(double{unit_m_} * middle);
  rows_[row].front() = free_;
  rows_[row].back() = 0;
  columns_per_m_[row] = static_cast<float>(kPerSigma / sigma_m);
  for (std::size_t column = 0; column < kColumns; ++column) {
    const double d_sigma = (static_cast<double>(column) + 0.5) / kPerSigma - kInFrontSigma;
    rows_[row][column + 1] = quantised(sensor.model().log_odds(d_sigma * sigma_m, sigma_m));
  }
  // A cell that holds the reading is at distance 0, which is in front.
  constexpr auto kAtReading = static_cast<std::size_t>(kPerSigma * kInFrontSigma);
  rows_[row][kAtReading + 1] = quantised(sensor.model().log_odds(0.0, sigma_m));
}

void EvidenceTable::describe(ReadingQuery& query) const {
  query.unit = unit_m_;
  query.three_sigma_per_z2 = static_cast<float>(InverseSensorModel::kBandSigma) * sigma_per_z2_;
  query.columns_per_m = columns_per_m_.data();
  query.log_odds = rows_.front().data();
  query.row_shift = shift_;
  query.row_length = static_cast<std::int32_t>(std::tuple_size_v<Row>);
  query.clear_per_reach = kInFrontSigma / static_cast<float>(InverseSensorModel::kBandSigma);
  query.free = free_;
  query.at_reading = at_reading_;
  query.sure_z = sure_z_m_;
  query.zero_column = kPerSigma * kInFrontSigma + 1.0F;
  query.last_column = static_cast<float>(kColumns + 1);
}

}  // namespace swiftlet
