// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/latency.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

Nanoseconds percentile(std::vector<Nanoseconds> values, double share) {
  SWIFTLET_REQUIRE(share > 0.0 && share <= 1.0, "a percentile lies above 0 and up to 1");
  if (values.empty()) return Nanoseconds{0};
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::ranges::nth_element(values, place);
  return *place;
}

DurationCounts::DurationCounts() : classes_(kClasses) {}

/// The first 128 classes are one nanosecond wide, and each doubling has 128 more.
std::size_t DurationCounts::class_of(std::uint64_t ns) {
  const auto bits = static_cast<unsigned>(std::bit_width(ns));
  if (bits <= kFineBits) return ns;
  const unsigned doubling = bits - kFineBits - 1;
  return (std::size_t{doubling} << kFineBits) + (ns >> doubling);
}

void DurationCounts::add(Nanoseconds duration) {
  constexpr std::int64_t kLongest = (std::int64_t{1} << kLongBits) - 1;
  const std::int64_t ns = std::clamp<std::int64_t>(duration.count(), 0, kLongest);
  Class& its = classes_[class_of(static_cast<std::uint64_t>(ns))];
  ++its.count;
  its.longest_ns = std::max(its.longest_ns, ns);
  ++count_;
}

Nanoseconds DurationCounts::percentile(double share) const {
  SWIFTLET_REQUIRE(share > 0.0 && share <= 1.0, "a percentile lies above 0 and up to 1");
  const double rank = std::ceil(share * static_cast<double>(count_));
  std::uint64_t so_far = 0;
  for (const Class& its : classes_) {
    so_far += its.count;
    if (its.count > 0 && static_cast<double>(so_far) >= rank) return Nanoseconds{its.longest_ns};
  }
  return Nanoseconds{0};
}

void Latency::add(const StageTimes& times) {
  frames_.add(times.total());
  total_ += times.total();
  for (std::size_t i = 0; i < stages_.size(); ++i) stages_[i].add(times.of[i]);
}

}  // namespace swiftlet
