// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the benchmark measures: which frames, in which order.

#include "swiftlet/eval/bench/bench_race.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/recordings.hpp"
#include "support/synthetic.hpp"

namespace swiftlet::test {
namespace {

using ::testing::ElementsAre;

// ---- which frames

/// A flight of `count` images, of which the first `lost` have no pose; the number of an image is
/// its stamp. Every `blind`-th image is empty.
class CountedSource final : public FrameSource {
 public:
  CountedSource(std::size_t count, std::size_t lost, std::size_t blind) : blind_(blind) {
    info_ = {"counted:", "+z", count, 0.07};
    tally_.of(FrameLoss::kNoPose) = lost;
  }
  Expected<std::optional<Frame>> next() override {
    const std::size_t number = tally_.of(FrameLoss::kNoPose) + tally_.delivered;
    if (number >= *info_.frame_count) return std::nullopt;
    ++tally_.delivered;
    Frame frame = wall_frame(small_camera(4, 3), number % blind_ == blind_ - 1 ? 0.0 : 2.0);
    frame.stamp.ns = static_cast<std::int64_t>(number);
    return frame;
  }
  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return tally_; }

 private:
  SourceInfo info_;
  FrameTally tally_;
  std::size_t blind_;
};
constexpr std::size_t kNever = 1'000'000;

std::vector<std::size_t> numbers_of(const eval::Workload& workload) {
  std::vector<std::size_t> numbers;
  for (const Frame& f : workload.frames) numbers.push_back(static_cast<std::size_t>(f.stamp.ns));
  return numbers;
}

TEST(BenchWorkload, spreads_the_frames_evenly_over_any_flight_and_holds_no_more_than_asked_for) {
  for_each_seed(200, [](Random& random) {
    const auto count = static_cast<std::size_t>(random.integer(1, 400));
    const auto frames = static_cast<std::size_t>(random.integer(1, 60));
    const auto warm_up = static_cast<std::size_t>(random.integer(0, 20));
    CountedSource source(count, 0, kNever);
    const auto made = eval::read_workload(source, {frames, warm_up, {}});
    ASSERT_TRUE(made);
    const auto numbers = numbers_of(*made);
    const std::size_t wanted = std::min(count, frames + warm_up);
    ASSERT_EQ(numbers.size(), wanted) << count;
    EXPECT_EQ(numbers.front(), 0U);
    const std::size_t gap = (count + wanted - 1) / wanted;
    EXPECT_GE(numbers.back() + gap, count) << "up to the end of the flight";
    for (std::size_t j = 1; j < numbers.size(); ++j) {
      EXPECT_GE(numbers[j] - numbers[j - 1] + 1, gap);
      EXPECT_LE(numbers[j] - numbers[j - 1], gap);
    }
    const bool is_short = count < frames + warm_up;
    EXPECT_EQ(made->warm_up, is_short ? std::min(warm_up, count / 5) : warm_up);
  });
}

TEST(BenchWorkload, makes_up_for_frames_that_were_lost_or_have_no_reading) {
  CountedSource source(40, 10, 4);
  const auto made = eval::read_workload(source, {10, 0, {}});
  ASSERT_TRUE(made);
  // 0, 4 and 8 had no pose, 11 nothing to see; the ones that are due are caught up on.
  EXPECT_THAT(numbers_of(*made), ElementsAre(10, 12, 13, 14, 16, 20, 24, 28, 32, 36));
  EXPECT_EQ(made->baseline_m, 0.07) << "as the source says";
}

TEST(BenchWorkload, needs_a_frame_with_a_reading_in_range) {
  CountedSource blind(10, 0, 1);
  EXPECT_EQ(eval::read_workload(blind, {}).error().code, ErrorCode::kCorruptInput);
  CountedSource source(10, 0, kNever);
  EXPECT_FALSE(eval::read_workload(source, {10, 0, 1.0})) << "the wall is 2 m away";
}

// ---- in which order

/// Writes down its name and the number of each frame; takes 1 ms for frame 0, 2 ms for frame 1, ...
class Diarist final : public eval::BenchmarkSubject {
 public:
  Diarist(std::string name, std::vector<std::string>& diary)
      : name_(std::move(name)), diary_(diary) {}
  std::optional<StageTimes> fuse(const Frame& frame) override {
    diary_.push_back(fmt::format("{}{}", name_, frame.stamp.ns));
    StageTimes times;
    times.of[0] = std::chrono::milliseconds(frame.stamp.ns + 1);
    return times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return 0; }
  void read_claims(eval::Claims&) const override {}

 private:
  std::string name_;
  std::vector<std::string>& diary_;
};

TEST(BenchRace, all_fuse_a_frame_before_the_next_and_warm_up_is_not_booked) {
  CountedSource source(5, 0, kNever);
  auto workload = eval::read_workload(source, {3, 2, {}});
  ASSERT_TRUE(workload);
  std::vector<std::string> diary;
  std::vector<eval::TimedSubject> timed;
  timed.push_back({.name = "a", .subject = std::make_unique<Diarist>("a", diary)});
  timed.push_back({.name = "b", .every = 2, .subject = std::make_unique<Diarist>("b", diary)});
  eval::race(*workload, timed);
  EXPECT_THAT(diary, ElementsAre("a0", "b0", "a1", "a2", "b2", "a3", "a4", "b4"));
  EXPECT_EQ(timed[0].latency.frame_count(), 3U);
  EXPECT_EQ(timed[1].latency.frame_count(), 2U);
  EXPECT_EQ(timed[0].latency.frame_percentile(0.5), std::chrono::milliseconds(4));
}

TEST(BenchRace, a_slow_contender_sees_five_measured_frames_if_there_are_as_many) {
  for (std::size_t frames = 1; frames <= 200; ++frames) {
    for (const std::size_t warm_up : {std::size_t{0}, frames / 7, frames - 1}) {
      eval::Workload workload;
      workload.frames.assign(frames, wall_frame(small_camera(4, 3), 2.0));
      workload.warm_up = warm_up;
      const std::size_t every = eval::every_nth(10, workload);
      std::size_t measured = 0;
      for (std::size_t i = warm_up; i < frames; ++i) measured += i % every == 0 ? 1 : 0;
      EXPECT_GE(measured, std::min<std::size_t>(5, frames - warm_up)) << frames << " " << warm_up;
      EXPECT_LE(every, 10U);
    }
  }
}

}  // namespace
}  // namespace swiftlet::test
