// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/clock_offset.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "support/seeds.hpp"
#include "swiftlet/mavlink/companion/latest_value.hpp"

namespace swiftlet::mavlink {
namespace {

using namespace std::chrono_literals;

/// Asks a clock that is `ahead` of ours; the question and the answer take their time.
void ask(ClockOffset& offset, Stamp now, Nanoseconds ahead, Nanoseconds there, Nanoseconds back) {
  offset.add(now, now + there + ahead, now + there + back);
}

TEST(ClockOffset, is_wrong_by_no_more_than_half_of_the_shortest_way) {
  test::for_each_seed(100, [](test::Random& random) {
    ClockOffset offset;
    EXPECT_FALSE(offset.ours_minus_theirs());
    const Nanoseconds ahead(random.integer<std::int64_t>(-1'000'000'000'000, 1'000'000'000'000));
    Stamp now{1'000'000'000'000};
    Nanoseconds shortest = 1s;
    for (int i = 0; i < 10; ++i, now = now + 1s) {
      const Nanoseconds there(random.integer(1'000, 20'000'000)),
          back(random.integer(1'000, 20'000'000));
      ask(offset, now, ahead, there, back);
      shortest = std::min(shortest, there + back);
      EXPECT_EQ(offset.round_trip(), shortest);
      EXPECT_LE(std::chrono::abs(*offset.ours_minus_theirs() + ahead), shortest / 2 + 1ns);
    }
  });
}

TEST(ClockOffset, refuses_answers_that_took_long_or_came_before_they_were_asked_for) {
  ClockOffset offset;
  ask(offset, {}, 5s, 60ms, 60ms);
  offset.add({100}, {0}, {50});
  EXPECT_FALSE(offset.ours_minus_theirs());
}

TEST(ClockOffset, believes_a_jump_when_three_answers_agree_and_no_single_stray) {
  ClockOffset offset;
  ask(offset, {0}, 5s, 1ms, 1ms);
  ask(offset, {1}, 9s, 1ms, 1ms);
  EXPECT_EQ(offset.ours_minus_theirs(), -5s);
  ask(offset, {2}, 5s, 1ms, 1ms);
  for (int i = 0; i < 2; ++i) ask(offset, {3}, 9s, 1ms, 1ms);
  EXPECT_EQ(offset.ours_minus_theirs(), -5s);
  ask(offset, {4}, 9s, 1ms, 1ms);
  EXPECT_EQ(offset.ours_minus_theirs(), -9s);
}

TEST(LatestValue, hands_over_whole_values_each_newer_than_the_last) {
  struct Pair {
    std::uint64_t a = 0, b = 0;
  };
  LatestValue<Pair> value;
  EXPECT_FALSE(value.take());
  constexpr std::uint64_t kValues = 200'000;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kValues; ++i) value.put({i, ~i});
  });
  std::uint64_t last = 0;
  while (last < kValues) {
    const auto pair = value.take();
    if (!pair) continue;
    ASSERT_EQ(pair->b, ~pair->a);
    ASSERT_GT(pair->a, last);
    last = pair->a;
  }
  writer.join();
  EXPECT_FALSE(value.take());
}

}  // namespace
}  // namespace swiftlet::mavlink
