// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the program tells of a ROS bag: what it is, what is taken of it, what was wrong with it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/run_program.hpp"
#include "support/bag_writer.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr Stamp kTakeOff{1'500'000'000'000'000'000};

/// Six seconds along x before a wall; after three its clock is set back by `set_back_s`.
void write_flight(const std::filesystem::path& path, int set_back_s) {
  BagWriter bag;
  bag.message("/tf_static", "tf2_msgs/TFMessage", kTakeOff,
              tf_message(kTakeOff, "base_link", "depth_optical", {0, 0, 0}));
  bag.message("/depth/camera_info", "sensor_msgs/CameraInfo", kTakeOff, info_message(24, 16, 20.0));
  for (int t_ms = 0; t_ms <= 6000; t_ms += 20) {
    const Stamp recorded = kTakeOff + std::chrono::milliseconds(t_ms);
    const Stamp stamp = t_ms < 3000 ? recorded : recorded - std::chrono::seconds(set_back_s);
    bag.message("/odom", "nav_msgs/Odometry", recorded,
                odometry_message(stamp, {1e-4 * t_ms, 0, 0}));
    Image<std::uint16_t> wall(24, 16, 2000);
    wall.at(t_ms / 20 % 24, 0) = to<std::uint16_t>(2001 + t_ms / 480);  // no two are the same
    if (t_ms % 100 == 0)
      bag.message("/depth/image_raw", "sensor_msgs/Image", recorded, image_message(wall, stamp));
  }
  bag.end_chunk();
  write_file(path, bag.bag());
}

TEST(BagTold, is_known_by_its_content_and_says_what_would_be_mapped) {
  const TempFolder folder;
  for (const std::string name : {"flight.bag.active", "FLIGHT.BAG", "flight"}) {
    write_flight(folder / name, 0);
    const Ended ended = run({"info", name}, folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("ROS bag 2.0"));
    EXPECT_THAT(ended.out, HasSubstr("would map: depth from /depth/image_raw (16UC1, 24 x 16"));
    EXPECT_THAT(ended.out, HasSubstr("would map: poses of base_link from /odom"));
  }
}

TEST(BagTold, maps_on_after_its_clock_was_set_back_and_tells_that) {
  const TempFolder folder;
  write_flight(folder / "set.bag", 30);
  const Ended ended = run({"map", "bag:set.bag", "--json", "-o", "m.swl"}, folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json summary = json::parse(ended.out);
  EXPECT_GE(summary["frames"].get<int>(), 61 - 3);
  EXPECT_EQ(summary["clock_steps"]["poses"]["back"], 1);
  EXPECT_NEAR(summary["clock_steps"]["poses"]["last_back_s"].get<double>(), 30.0, 0.1);
  EXPECT_EQ(summary["restarts"], 0) << "one map";
  const auto notes = summary["notes"].get<std::vector<std::string>>();
  EXPECT_THAT(notes, Contains(HasSubstr("depth from /depth/image_raw")));
  EXPECT_THAT(notes, Contains(HasSubstr("the clock of the poses was set back 1 time, by 30 s")));
  const Ended exam = run({"doctor", "bag:set.bag", "--seconds", "0"}, folder.path());
  EXPECT_THAT(exam.out, HasSubstr("the clock of the images was set back 1 time"));
  EXPECT_THAT(exam.out, HasSubstr("depth from /depth/image_raw"));
}

}  // namespace
}  // namespace swiftlet::test
