// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/real_time_source.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <utility>
#include <vector>

#include "swiftlet/source/rig/rig.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// Frames 20 ms apart, then the end or a fault.
class Recorded final : public FrameSource {
 public:
  Recorded(int frames, bool has_fault) : frames_(frames), has_fault_(has_fault) {
    tally_.of(FrameLoss::kPoseGap) = 3;
  }
  Expected<std::optional<Frame>> next() override {
    if (given_ == frames_) {
      if (std::exchange(has_fault_, false)) return fail(ErrorCode::kIo, "disk", "gone");
      return std::nullopt;
    }
    ++tally_.delivered;
    return Frame{Stamp{} + milliseconds(20 * given_++),
                 DepthImage{},
                 PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value(),
                 {}};
  }
  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return tally_; }
  std::vector<RigEvent> take_events() override {
    if (std::exchange(has_told_, true)) return {};
    return {{RigEventKind::kSkipped, "7.png", "damaged"}};
  }

 private:
  bool has_told_ = false;
  int frames_;
  bool has_fault_;
  int given_ = 0;
  SourceInfo info_{"recorded:", "+z", std::nullopt, std::nullopt};
  FrameTally tally_;
};

TEST(RealTime, gives_every_frame_not_before_its_time_to_a_mapper_that_keeps_up) {
  const auto start = Clock::now();
  const auto source = play_in_real_time(std::make_unique<Recorded>(10, false), {.capacity = 10});
  for (int i = 0; i < 10; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->stamp, Stamp{} + milliseconds(20 * i));
    // The first frame starts the clock, at some time after `start`.
    EXPECT_GE(Clock::now() - start, milliseconds(20 * i));
    ASSERT_TRUE((*frame)->seen_at);
    EXPECT_GE(*(*frame)->seen_at - start, milliseconds(20 * i));
    EXPECT_LE(*(*frame)->seen_at, Clock::now()) << "a frame is not given before it is seen";
  }
  const auto end = source->next();
  EXPECT_TRUE(end && !*end);
  FrameTally tally = source->tally();
  EXPECT_EQ(tally.delivered, 10U);
  EXPECT_EQ(tally.of(FrameLoss::kPoseGap), 3U) << "the recording's own";
  EXPECT_EQ(tally.of(FrameLoss::kOverload), 0U);
}

TEST(RealTime, loses_the_oldest_whole_frames_and_counts_them_when_the_mapper_is_late) {
  const auto source =
      play_in_real_time(std::make_unique<Recorded>(50, false), {.capacity = 2, .speed = 1e6});
  std::vector<Frame> frames;
  auto frame = source->next();
  // The mapper is busy until all 50 have been played, which is when the tally says so.
  while (frame && *frame) {
    frames.push_back(std::move(**frame));
    frame = source->next();
  }
  FrameTally tally = source->tally();
  EXPECT_EQ(tally.delivered, frames.size());
  EXPECT_EQ(tally.delivered + tally.of(FrameLoss::kOverload), 50U) << "used or counted";
  EXPECT_EQ(frames.back().stamp, Stamp{} + milliseconds(20 * 49)) << "the newest is never lost";
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_LT(frames[i - 1].stamp, frames[i].stamp);
}

TEST(RealTime, passes_on_the_fault_of_its_source_after_the_frames_before_it) {
  const auto source =
      play_in_real_time(std::make_unique<Recorded>(3, true), {.capacity = 5, .speed = 1e6});
  for (int i = 0; i < 3; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
  }
  const auto fault = source->next();
  ASSERT_FALSE(fault);
  EXPECT_EQ(fault.error().where, "disk");
  const auto end = source->next();
  EXPECT_TRUE(end && !*end);
}

/// One frame; after that all are lost, until somebody has had enough.
class Searching final : public FrameSource {
 public:
  Expected<std::optional<Frame>> next() override {
    if (tally_.delivered++ == 0) {
      return Frame{Stamp{}, DepthImage{}, PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value(), {}};
    }
    while (!is_unwanted_()) ++tally_.of(FrameLoss::kPoseStale);
    return std::nullopt;
  }
  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return tally_; }
  void stop_when(const std::function<bool()>& is_unwanted) override { is_unwanted_ = is_unwanted; }

 private:
  SourceInfo info_{"searching:", "+z", std::nullopt, std::nullopt};
  FrameTally tally_;
  std::function<bool()> is_unwanted_;
};

TEST(RealTime, tells_what_is_lost_while_no_frame_comes_and_ends_when_it_is_asked_to) {
  const auto source = play_in_real_time(std::make_unique<Searching>());
  std::vector<std::size_t> lost;
  source->stop_when([&] {
    FrameTally tally = source->tally();
    lost.push_back(tally.of(FrameLoss::kPoseStale));
    return lost.size() > 2 && lost.back() > lost.front();
  });
  const auto frame = source->next();
  ASSERT_TRUE(frame && *frame);
  const auto end = source->next();
  ASSERT_TRUE(end) << "no error: somebody wants to go home";
  EXPECT_FALSE(*end);
  EXPECT_EQ(source->tally().delivered, 1U);
}

TEST(RealTime, passes_on_which_records_were_skipped) {
  const auto source = play_in_real_time(std::make_unique<Recorded>(2, false));
  std::vector<RigEvent> events;
  for (bool has_more = true; has_more;) {
    const auto frame = source->next();
    has_more = frame && *frame;
    for (RigEvent& event : source->take_events()) events.push_back(std::move(event));
  }
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].who, "7.png");
}

/// A rig that has seen an image more with each frame.
class Seeing final : public FrameSource {
 public:
  Seeing() { facts_.cameras.resize(1); }
  Expected<std::optional<Frame>> next() override {
    if (facts_.cameras[0].samples == 5) return std::nullopt;
    const auto intrinsics = PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value();
    const Stamp stamp{static_cast<std::int64_t>(facts_.cameras[0].samples) * 1'000'000};
    facts_.cameras[0].note(DepthFrame{stamp, DepthImage{}, intrinsics});
    return Frame{stamp, DepthImage{}, intrinsics, {}};
  }
  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return tally_; }
  const RigStatistics* statistics() const override { return &facts_; }
  const RigOptions* rig() const override { return &rig_; }

 private:
  SourceInfo info_{"seeing:", "+z", std::nullopt, std::nullopt};
  FrameTally tally_;
  RigStatistics facts_;
  RigOptions rig_;
};

TEST(RealTime, passes_on_the_facts_and_the_rig_of_its_source) {
  const auto source = play_in_real_time(std::make_unique<Seeing>(), {.capacity = 5});
  const RigStatistics* const facts = source->statistics();
  ASSERT_NE(facts, nullptr);
  ASSERT_NE(source->rig(), nullptr);
  EXPECT_EQ(source->rig()->cameras.size(), 1U);
  for (bool has_more = true; has_more;) {
    const auto frame = source->next();
    has_more = frame && *frame;
  }
  EXPECT_EQ(source->statistics(), facts) << "they stay where they are";
  EXPECT_EQ(facts->cameras.at(0).samples, 5U);
  const auto other = play_in_real_time(std::make_unique<Recorded>(2, false));
  EXPECT_EQ(other->statistics(), nullptr) << "it is no rig";
}

TEST(RealTime, can_be_left_before_its_end) {
  const auto start = Clock::now();
  auto source = play_in_real_time(std::make_unique<Recorded>(100'000, false));
  ASSERT_TRUE(source->next());
  source.reset();
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(60)) << "not the 2000 s of the recording";
}

}  // namespace
}  // namespace swiftlet
