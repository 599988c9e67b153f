// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/latency.hpp"

#include <algorithm>
#include <cmath>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::app {

Nanoseconds percentile(std::vector<Nanoseconds> values, double share) {
  SWIFTLET_REQUIRE(share > 0.0 && share <= 1.0, "a percentile lies above 0 and up to 1");
  if (values.empty()) return Nanoseconds{0};
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::ranges::nth_element(values, place);
  return *place;
}

Nanoseconds Latency::total() const {
  Nanoseconds sum{0};
  for (const StageTimes& times : frames_) sum += times.total();
  return sum;
}

Nanoseconds Latency::frame_percentile(double share) const {
  std::vector<Nanoseconds> values;
  for (const StageTimes& times : frames_) values.push_back(times.total());
  return percentile(std::move(values), share);
}

Nanoseconds Latency::stage_percentile(Stage stage, double share) const {
  std::vector<Nanoseconds> values;
  for (const StageTimes& times : frames_)
    values.push_back(times.of[static_cast<std::size_t>(stage)]);
  return percentile(std::move(values), share);
}

}  // namespace swiftlet::app
