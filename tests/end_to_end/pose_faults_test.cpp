// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What poses do to the map when they lie, and what the rig does about it: the table of docs/rig.md
// (`end_to_end_tests --gtest_filter=PoseFaults.*` prints it).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "end_to_end/rig_flights.hpp"
#include "support/map_bits.hpp"

namespace swiftlet {
namespace {

using test::Flown;
using test::Score;

constexpr double kTolerance = 0.01;  // of the clean flight's accuracy

std::string losses(const FrameTally& tally) {
  std::string text;
  for (std::size_t i = 0; i < kFrameLossNames.size(); ++i) {
    if (tally.lost[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", tally.lost[i], kFrameLossNames[i]);
  }
  return text.empty() ? "none" : text;
}

class PoseFaults : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    truth_ = new Flown(test::fly_room("?noise=off"));
    clean_ = new Flown(test::fly_room(""));
    fmt::print(
        "| flight | accuracy | against clean | frames mapped | frames refused | poses refused "
        "| jumps | alarms |\n|---|---|---|---|---|---|---|---|\n");
    print_row("clean", *clean_);
  }
  static void TearDownTestSuite() {
    delete truth_;
    delete clean_;
  }

  static double accuracy(const Flown& flown) {
    return test::score_of(flown.mapper, truth_->mapper).accuracy();
  }
  static void print_row(const std::string& name, const Flown& flown) {
    fmt::print("| {} | {:.2f} % | {:+.2f} % | {} | {} | {} | {} | {} |\n", name,
               100 * accuracy(flown), 100 * (accuracy(flown) - accuracy(*clean_)),
               flown.tally.delivered, losses(flown.tally), flown.tally.poses_refused,
               flown.tally.pose_jumps, flown.tally.stale_alarms);
  }
  /// Flies with a fault and adds its row to the table.
  static Flown fly(const std::string& fault) {
    Flown flown = test::fly_room("?fault=" + fault);
    print_row(fault, flown);
    return flown;
  }
  static void expect_as_good_as_clean(const Flown& flown) {
    EXPECT_NEAR(accuracy(flown), accuracy(*clean_), kTolerance);
    const auto known = [](const Flown& f) {
      return static_cast<double>(test::score_of(f.mapper, truth_->mapper).coverage);
    };
    EXPECT_GT(known(flown), 0.97 * known(*clean_));
  }
  static std::size_t lost(const Flown& flown, FrameLoss loss) {
    FrameTally tally = flown.tally;
    return tally.of(loss);
  }

  static Flown* truth_;
  static Flown* clean_;
};
Flown* PoseFaults::truth_ = nullptr;
Flown* PoseFaults::clean_ = nullptr;

TEST_F(PoseFaults, none_gives_a_map_that_agrees_with_the_truth) {
  EXPECT_GT(accuracy(*clean_), 0.97);
  EXPECT_EQ(clean_->tally.pose_jumps, 0U);
  EXPECT_EQ(clean_->tally.stale_alarms, 0U);
}

TEST_F(PoseFaults, three_percent_nan_cost_no_frame) {
  const Flown flown = fly("nan");
  expect_as_good_as_clean(flown);
  EXPECT_EQ(flown.tally.delivered, clean_->tally.delivered);
  EXPECT_GT(flown.tally.poses_refused, clean_->tally.poses_refused + 40);
}

TEST_F(PoseFaults, a_jump_of_half_a_metre_is_taken_out) {
  const Flown flown = fly("jump");
  expect_as_good_as_clean(flown);
  EXPECT_EQ(flown.tally.pose_jumps, 1U);
  EXPECT_EQ(flown.epochs, 0U);
}

TEST_F(PoseFaults, a_jump_that_is_followed_begins_the_map_anew) {
  const Flown flown = fly("jump&on_jump=clear");
  EXPECT_EQ(flown.epochs, 1U);
  // The new map is sharp, but lies where the tracker says: 0.5 m from the truth.
  EXPECT_LT(accuracy(flown), accuracy(*clean_) - kTolerance);
}

TEST_F(PoseFaults, a_gap_of_300_ms_costs_the_frames_in_it) {
  const Flown flown = fly("gap");
  expect_as_good_as_clean(flown);
  const std::size_t in_the_gap = lost(flown, FrameLoss::kPoseGap);
  EXPECT_GE(in_the_gap, 3U);
  EXPECT_LE(in_the_gap, 4U);
  EXPECT_EQ(flown.tally.delivered + in_the_gap, clean_->tally.delivered);
}

TEST_F(PoseFaults, a_delay_of_40_ms_on_the_way_changes_nothing_at_all) {
  const Flown flown = fly("delay");
  EXPECT_EQ(accuracy(flown), accuracy(*clean_));
  EXPECT_EQ(flown.tally.delivered, clean_->tally.delivered);
}

TEST_F(PoseFaults, stamps_that_are_40_ms_late_are_made_good_by_the_pose_offset) {
  const Flown wrong = fly("late_stamps");
  const Flown righted = fly("late_stamps&pose_offset_ms=40");
  EXPECT_LT(accuracy(wrong), accuracy(righted)) << "or the test shows nothing";
  expect_as_good_as_clean(righted);
}

TEST_F(PoseFaults, swapped_stamps_do_no_harm) {
  const Flown flown = fly("swapped");
  expect_as_good_as_clean(flown);
}

TEST_F(PoseFaults, a_dead_tracker_raises_the_alarm_and_leaves_the_map_as_it_was) {
  Flown flown = fly("dead");
  Flown until_then = test::fly_room("?frames=50");  // 5 s of images
  print_row("clean, ended when dead", until_then);
  EXPECT_EQ(test::bits_of(flown.mapper), test::bits_of(until_then.mapper));
  EXPECT_EQ(flown.tally.stale_alarms, 1U);
  EXPECT_GT(lost(flown, FrameLoss::kPoseStale), 80U);
  std::size_t refused = 0;
  for (const std::size_t count : flown.tally.lost) refused += count;
  EXPECT_EQ(flown.tally.delivered + refused, 141U) << "every frame is mapped or counted";
}

}  // namespace
}  // namespace swiftlet
