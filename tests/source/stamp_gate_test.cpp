// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/stamp_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

struct Sample {
  Stamp stamp;
  int number = 0;  // negative: its stamp is wrong
  ClockDomain clock = ClockDomain::kUnspecified;
};

/// Runs samples through a gate; the numbers of those that came out.
std::vector<int> passed(const std::vector<Sample>& samples, StampGate<Sample>& gate) {
  std::vector<int> out;
  const auto take = [&] {
    while (const auto sample = gate.pop()) out.push_back(sample->number);
  };
  for (const Sample& sample : samples) {
    gate.push(sample);
    take();
  }
  gate.finish();
  take();
  return out;
}

/// A stream of a period, whose clock is set now and then, with wrong stamps among the good ones.
struct Stream {
  std::vector<Sample> samples;
  std::size_t wrong = 0, set_back = 0, set = 0;

  Stream(test::Random& random, double wrong_share, double set_share) {
    const double period_s = random.real(0.004, 1.0);
    double clock_s = 1.5e9;
    int quiet = 0;  // samples since the last disturbance
    for (int i = 0; i < 1000; ++i, ++quiet) {
      clock_s += period_s * random.real(0.7, 1.3);
      if (quiet > 6 && i < 990 && random.chance(set_share)) {
        const double by_s = random.real(30.0, 5000.0) * (random.chance(0.5) ? 1 : -1);
        set_back += by_s < 0 ? 1 : 0;
        ++set;
        clock_s += by_s;
        quiet = 0;
      }
      if (quiet > 3 && random.chance(wrong_share)) {
        const double by_s = random.real(60.0, 7200.0) * (random.chance(0.5) ? 1 : -1);
        samples.push_back({Stamp{std::llround((clock_s + by_s) * 1e9)}, -1});
        ++wrong;
        quiet = 0;
      }
      samples.push_back({Stamp{std::llround(clock_s * 1e9)}, i});
    }
  }
};

TEST(StampGate, lets_no_lonely_wrong_stamp_pass_and_loses_no_good_one) {
  test::for_each_seed(50, [](test::Random& random) {
    const Stream stream(random, 0.05, 0.0);
    StampGate<Sample> gate;
    const std::vector<int> out = passed(stream.samples, gate);
    EXPECT_GT(stream.wrong, 0U);
    EXPECT_EQ(gate.refused(), stream.wrong);
    ASSERT_EQ(out.size(), 1000U);
    EXPECT_TRUE(std::ranges::is_sorted(out));
    EXPECT_GE(out.front(), 0);
    EXPECT_EQ(gate.steps().back, 0U);
  });
}

TEST(StampGate, follows_a_clock_that_is_set_back_or_ahead_and_loses_nothing) {
  test::for_each_seed(50, [](test::Random& random) {
    const Stream stream(random, 0.0, 0.01);
    StampGate<Sample> gate;
    EXPECT_EQ(passed(stream.samples, gate).size(), 1000U);
    EXPECT_EQ(gate.refused(), 0U);
    EXPECT_EQ(gate.steps().back, stream.set_back);
  });
}

TEST(StampGate, loses_at_most_three_samples_where_clock_and_wrong_stamps_come_together) {
  test::for_each_seed(50, [](test::Random& random) {
    const Stream stream(random, 0.1, 0.02);
    StampGate<Sample> gate;
    const std::vector<int> out = passed(stream.samples, gate);
    EXPECT_EQ(std::ranges::count(out, -1), 0);
    EXPECT_GE(out.size() + StampJudge::kConfirm * stream.set, 1000U);
  });
}

TEST(StampGate, lets_slow_streams_and_short_ones_pass) {
  for (const int period_s : {1, 5, 50}) {
    for (int count = 1; count < 8; ++count) {
      std::vector<Sample> samples;
      for (int i = 0; i < count; ++i) samples.push_back({Stamp{1'000'000'000LL * period_s * i}, i});
      StampGate<Sample> gate;
      EXPECT_EQ(passed(samples, gate).size(), samples.size()) << period_s << " s, " << count;
    }
  }
}

TEST(StampGate, goes_on_after_a_silence_and_into_a_slower_rate) {
  std::vector<Sample> samples;
  for (int i = 0; i < 100; ++i) {
    const int t_ms = i < 40 ? 33 * i : i < 70 ? 300'000 + 33 * i : 2'000'000 + 20'000 * i;
    samples.push_back({Stamp{} + milliseconds(t_ms), i});
  }
  StampGate<Sample> gate;
  EXPECT_EQ(passed(samples, gate).size(), 100U);
}

TEST(StampGate, believes_the_second_stamp_and_not_the_first_if_the_first_is_the_wrong_one) {
  std::vector<Sample> samples{{Stamp{} + std::chrono::hours(1), -1}};
  for (int i = 0; i < 10; ++i) samples.push_back({Stamp{} + milliseconds(33 * i), i});
  StampGate<Sample> gate;
  const auto out = passed(samples, gate);
  EXPECT_EQ(out.size(), 10U);
  EXPECT_EQ(gate.refused(), 1U);
  EXPECT_EQ(gate.steps().back, 0U);
}

TEST(StampGate, takes_samples_of_another_clock_for_a_stream_of_their_own) {
  std::vector<Sample> samples;
  for (int i = 0; i < 2; ++i)
    samples.push_back({Stamp{} + milliseconds(33 * i), i, ClockDomain::kDevice});
  for (int i = 2; i < 9; ++i)
    samples.push_back(
        {Stamp{1'500'000'000'000'000'000} + milliseconds(33 * i), i, ClockDomain::kGlobal});
  StampGate<Sample> gate;
  EXPECT_EQ(passed(samples, gate).size(), 9U) << "the gate after it judges clocks";
}

TEST(StampGate, survives_stamps_from_the_ends_of_the_scale) {
  test::for_each_seed(20, [](test::Random& random) {
    StampGate<Sample> gate;
    std::size_t out = 0;
    for (int i = 0; i < 300; ++i) {
      constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();
      gate.push({Stamp{random.integer(-kEnd, kEnd)}, i});
      while (gate.pop()) ++out;
    }
    EXPECT_LT(out, 30U);
  });
}

}  // namespace
}  // namespace swiftlet
