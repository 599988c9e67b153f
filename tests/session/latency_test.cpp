// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/latency.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

TEST(Percentile, is_the_smallest_value_that_enough_others_do_not_exceed) {
  test::for_each_seed(100, [](test::Random& random) {
    std::vector<Nanoseconds> values(random.integer<std::size_t>(1, 60));
    for (auto& v : values) v = Nanoseconds(random.integer(0, 50));
    const double share = random.real(1e-6, 1.0);
    const Nanoseconds answer = percentile(values, share);
    const auto covered = [&](Nanoseconds limit) {
      const auto n = std::ranges::count_if(values, [&](Nanoseconds v) { return v <= limit; });
      return static_cast<double>(n) >= share * static_cast<double>(values.size());
    };
    EXPECT_TRUE(covered(answer));
    EXPECT_FALSE(covered(answer - Nanoseconds(1)));
    EXPECT_NE(std::ranges::find(values, answer), values.end());
  });
}

TEST(Percentile, of_nothing_is_zero) { EXPECT_EQ(percentile({}, 0.5), Nanoseconds(0)); }

TEST(Latency, adds_stages_up_to_frames) {
  Latency latency;
  for (int i = 1; i <= 100; ++i) {
    latency.add({{Nanoseconds(i), Nanoseconds(0), Nanoseconds(2 * i), Nanoseconds(1)}});
  }
  EXPECT_EQ(latency.frame_percentile(0.50), Nanoseconds(151));
  EXPECT_EQ(latency.frame_percentile(0.99), Nanoseconds(298));
  EXPECT_EQ(latency.stage_percentile(Stage::kIntegrate, 0.99), Nanoseconds(198));
  EXPECT_EQ(latency.total(), Nanoseconds(3 * 5050 + 100));
}

// A flight of hours: the vectors of 0.1.0 grew with every frame.
TEST(DurationCounts, tell_percentiles_to_within_a_hundredth) {
  test::for_each_seed(20, [](test::Random& random) {
    DurationCounts counts;
    std::vector<Nanoseconds> values;
    const double longest = random.real(1.0, 40.0);
    for (int i = 0; i < 2000; ++i) {
      values.emplace_back(static_cast<std::int64_t>(std::exp2(random.real(0.0, longest))));
      counts.add(values.back());
    }
    for (const double share : {1e-9, 0.01, 0.5, 0.9, 0.99, 1.0}) {
      const auto exact = static_cast<double>(percentile(values, share).count());
      const auto told = static_cast<double>(counts.percentile(share).count());
      EXPECT_GE(told, exact) << random.repeat();
      EXPECT_LE(told, exact * (1.0 + 1.0 / 128.0)) << random.repeat();
    }
    EXPECT_EQ(counts.percentile(1.0), *std::ranges::max_element(values)) << "the longest is exact";
  });
}

TEST(DurationCounts, take_whatever_a_clock_says) {
  DurationCounts counts;
  EXPECT_EQ(counts.percentile(0.5), Nanoseconds(0)) << "of nothing";
  counts.add(Nanoseconds::min());
  EXPECT_EQ(counts.percentile(1.0), Nanoseconds(0));
  counts.add(Nanoseconds::max());
  EXPECT_GT(counts.percentile(1.0), std::chrono::hours(4));
}

}  // namespace
}  // namespace swiftlet
