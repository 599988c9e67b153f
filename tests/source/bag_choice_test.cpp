// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What is taken of a ROS bag that holds more than one rig needs, or not what was asked for.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/bag_writer.hpp"
#include "support/recordings.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::read_all;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Stamp kStart{1'500'000'000'000'000'000};
Stamp ms(int value) { return kStart + std::chrono::milliseconds(value); }

/// A short flight along x in a ROS bag; a test adds or spoils something.
class BagChoice : public ::testing::Test {
 protected:
  void pose(int t_ms) {
    bag_.message("/odom", "nav_msgs/Odometry", ms(t_ms),
                 test::odometry_message(ms(t_ms), {1e-3 * t_ms, 0, 1}));
  }
  void tf(int t_ms, const std::string& frame) {
    bag_.message("/tf", "tf2_msgs/TFMessage", ms(t_ms),
                 test::tf_message(ms(t_ms), "odom", frame, {1e-3 * t_ms, 0, 1}));
  }
  void mount() {
    bag_.message("/tf_static", "tf2_msgs/TFMessage", kStart,
                 test::tf_message(kStart, "base_link", "depth_optical", {0, 0, 0}));
  }
  void info(const std::string& camera, const std::string& message) {
    bag_.message(camera + "/camera_info", "sensor_msgs/CameraInfo", kStart, message);
  }
  void image(const std::string& camera, int t_ms, const Image<std::uint16_t>& pixels,
             std::string_view encoding = "16UC1") {
    bag_.message(camera + "/image_raw", "sensor_msgs/Image", ms(t_ms),
                 test::image_message(pixels, ms(t_ms), encoding));
  }
  /// Eleven images of one camera, and poses.
  void flight(const std::string& camera, const std::string& info_text) {
    info(camera, info_text);
    for (int t = 0; t <= 1000; t += 50) {
      pose(t);
      if (t % 100 == 0) image(camera, t, test::flat(2000));
    }
  }
  std::string address(const std::string& options = "") {
    bag_.end_chunk();
    test::write_file(folder_ / "f.bag", bag_.bag());
    return "bag:" + (folder_ / "f.bag").string() + options;
  }
  static Image<std::uint16_t> speckle(test::Random& random) {
    Image<std::uint16_t> pixels(24, 16);
    for (auto& z : pixels.pixels()) z = static_cast<std::uint16_t>(random.integer(10, 4000));
    return pixels;
  }

  test::TempFolder folder_;
  test::BagWriter bag_;
};

TEST_F(BagChoice, takes_depth_and_not_the_infrared_that_comes_before_it_and_says_so) {
  test::Random random;
  mount();
  info("/ir", test::info_message(24, 16, 20.0));
  image("/ir", 0, speckle(random), "mono16");
  flight("/cam/depth", test::info_message(24, 16, 20.0));
  const std::string place = address();
  const auto reading = read_all(place);
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 11U);
  EXPECT_EQ(reading.frames[0].depth.raw.at(0, 0), 2000);
  const auto source = open_source(place);
  ASSERT_TRUE(source);
  ASSERT_EQ((*source)->info().choices.size(), 2U);
  EXPECT_THAT((*source)->info().choices[0],
              AllOf(HasSubstr("depth from /cam/depth/image_raw (16UC1, 24 x 16, 10.0 Hz)"),
                    HasSubstr("not from /ir/image_raw (mono16")));
  EXPECT_THAT((*source)->info().choices[1], HasSubstr("poses of base_link from /odom"));
}

TEST_F(BagChoice, takes_infrared_alone_for_no_depth_unless_it_is_told_to) {
  test::Random random;
  mount();
  info("/ir", test::info_message(24, 16, 20.0));
  image("/ir", 0, speckle(random), "mono16");
  pose(0);
  const std::string place = address();
  EXPECT_THAT(read_all(place).error, AllOf(HasSubstr("none of its images is plainly depth"),
                                           HasSubstr("/ir/image_raw"), HasSubstr("--depth-topic")));
  EXPECT_EQ(read_all(place + "?depth_topic=/ir/image_raw").error, "");
}

TEST_F(BagChoice, asks_which_of_two_depth_cameras_is_meant) {
  mount();
  for (const std::string camera : {"/front/depth", "/back/depth"}) {
    info(camera, test::info_message(24, 16, 20.0));
    image(camera, 0, test::flat(2000));
  }
  pose(0);
  const std::string place = address();
  EXPECT_THAT(read_all(place).error,
              AllOf(HasSubstr("/front/depth/image_raw (16UC1, 24 x 16"),
                    HasSubstr("/back/depth/image_raw"), HasSubstr("--depth-topic")));
  EXPECT_EQ(read_all(place + "?depth_topic=back/depth/image_raw").error, "")
      << "with or without the slash";
}

TEST_F(BagChoice, names_the_frames_there_are_for_one_there_is_not) {
  mount();
  tf(0, "base_link");
  tf(1, "camera_link");
  flight("/depth", test::info_message(24, 16, 20.0));
  const std::string place = address();
  EXPECT_THAT(read_all(place + "?pose_topic=/tf&body_frame=base_lnik").error,
              AllOf(HasSubstr("no frame base_lnik"), HasSubstr("/tf"),
                    HasSubstr("did you mean base_link?"), HasSubstr("camera_link")));
  EXPECT_THAT(read_all(place + "?body_frame=nobody").error, HasSubstr("no frame nobody"));
  EXPECT_THAT(read_all(place + "?pose_topic=/odon").error, HasSubstr("did you mean /odom?"));
}

TEST_F(BagChoice, passes_over_a_pose_that_is_told_once) {
  mount();
  bag_.message("/goal_pose", "nav_msgs/Odometry", ms(0), test::odometry_message(ms(0), {9, 9, 9}));
  flight("/depth", test::info_message(24, 16, 20.0));
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 11U);
  EXPECT_NEAR(reading.frames[10].T_world_camera.translation().x(), 1.0, 1e-9);
}

TEST_F(BagChoice, names_the_topics_that_have_the_same_claim_to_be_the_poses) {
  mount();
  for (int t = 0; t <= 1000; t += 20)
    bag_.message("/wheel/odom", "nav_msgs/Odometry", ms(t),
                 test::odometry_message(ms(t), {0, 0, 0}));
  flight("/depth", test::info_message(24, 16, 20.0));
  EXPECT_THAT(read_all(address()).error,
              AllOf(HasSubstr("/wheel/odom (nav_msgs/Odometry, 50.0 Hz)"),
                    HasSubstr("/odom (nav_msgs/Odometry, 20.0 Hz)"), HasSubstr("--pose-topic")));
  EXPECT_EQ(read_all(address("?pose_topic=/odom")).error, "");
}

TEST_F(BagChoice, leaves_out_an_image_and_a_pose_that_are_none) {
  mount();
  info("/depth", test::info_message(24, 16, 0.0));  // not calibrated yet
  info("/depth", test::info_message(24, 16, 20.0));
  const std::string whole = test::image_message(test::flat(2000), ms(500), "16UC1");
  const std::string cut = test::odometry_message(ms(501), {0, 0, 0}).substr(0, 60);
  for (int t = 0; t <= 1000; t += 50) {
    pose(t);
    if (t == 500) bag_.message("/odom", "nav_msgs/Odometry", ms(t), cut);
    if (t % 100 != 0) continue;
    if (t == 500)
      bag_.message("/depth/image_raw", "sensor_msgs/Image", ms(t), whole.substr(0, 100));
    else
      image("/depth", t, test::flat(2000));
  }
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), 10U);
  EXPECT_EQ(reading.tally.lost[static_cast<std::size_t>(FrameLoss::kImageUnreadable)], 1U);
  EXPECT_EQ(std::ranges::count(reading.events, RigEventKind::kSkipped, &RigEvent::kind), 2);
}

TEST_F(BagChoice, takes_compressed_depth_where_there_are_no_plain_images) {
  const std::string topic = "/cam/depth/image_raw/compressedDepth";
  for (const bool are_there_plain : {false, true}) {
    bag_ = test::BagWriter();
    mount();
    info("/cam/depth", test::info_message(24, 16, 20.0));
    test::write_png(folder_ / "depth.png", test::flat(1500));
    const std::string packed = std::string(12, '\0') + test::content_of(folder_ / "depth.png");
    for (int t = 0; t <= 1000; t += 50) {
      pose(t);
      if (t % 100 != 0) continue;
      const auto message = test::Bytes().header(0, ms(t), "depth_optical");
      bag_.message(topic, "sensor_msgs/CompressedImage", ms(t),
                   test::Bytes(message).string("16UC1; compressedDepth png").string(packed).text());
      if (are_there_plain) image("/cam/depth", t, test::flat(2000));
    }
    const auto reading = read_all(address());
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), 11U);
    EXPECT_EQ(reading.frames[0].depth.raw.at(0, 0), are_there_plain ? 2000 : 1500);
    EXPECT_EQ(reading.frames[0].intrinsics.fx(), 20.0) << "of the camera_info beside the images";
  }
}

TEST_F(BagChoice, names_compressed_depth_that_is_damaged) {
  mount();
  pose(0);
  info("/cam/depth", test::info_message(24, 16, 20.0));
  bag_.message("/cam/depth/image_raw/compressedDepth", "sensor_msgs/CompressedImage", kStart, "x");
  const std::string place = address();
  for (const std::string options : {"", "?depth_topic=/cam/depth/image_raw/compressedDepth"})
    EXPECT_THAT(read_all(place + options).error, HasSubstr("/cam/depth/image_raw/compressedDepth"));
}

TEST_F(BagChoice, applies_binning_and_region_of_a_camera_info) {
  struct Case {
    std::string info;
    double f, cx, cy;
  };
  const Case cases[]{
      {test::info_message(48, 32, 40.0, {}, {.binning = {2, 2}}), 20.0, 12.0, 8.0},
      {test::info_message(48, 32, 20.0, {}, {.region = {20, 10, 16, 24}}), 20.0, 4.0, 6.0},
      {test::info_message(96, 64, 40.0, {}, {.binning = {2, 2}, .region = {20, 10, 32, 48}}), 20.0,
       14.0, 11.0},
      // The size was adapted and K was not, or both were: the principal point tells.
      {test::info_message(24, 16, 40.0, {}, {.cx = 24.0, .cy = 16.0, .binning = {2, 2}}), 20.0,
       12.0, 8.0},
      {test::info_message(24, 16, 20.0, {}, {.binning = {2, 2}}), 20.0, 12.0, 8.0},
  };
  for (const Case& each : cases) {
    bag_ = test::BagWriter();
    mount();
    flight("/depth", each.info);
    const auto reading = read_all(address());
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), 11U);
    const PinholeIntrinsics& intrinsics = reading.frames[0].intrinsics;
    EXPECT_EQ(intrinsics.fx(), each.f);
    EXPECT_EQ(intrinsics.cx(), each.cx);
    EXPECT_EQ(intrinsics.cy(), each.cy);
    EXPECT_EQ(intrinsics.width(), 24);
  }
  bag_ = test::BagWriter();
  mount();
  flight("/depth", test::info_message(48, 32, 40.0));
  EXPECT_THAT(read_all(address()).error, HasSubstr("another size than its CameraInfo"))
      << "decimated, and nothing tells";
}

TEST_F(BagChoice, gives_each_image_the_intrinsics_of_its_own_time) {
  for (const bool info_comes_first : {true, false}) {
    bag_ = test::BagWriter();
    mount();
    for (int t = 0; t <= 1000; t += 50) {
      pose(t);
      if (t % 100 != 0) continue;
      const double f_px = t < 500 ? 20.0 : 40.0;
      const auto tell = [&] {
        info("/depth", test::info_message(24, 16, f_px, {}, {.stamp = ms(t)}));
      };
      if (info_comes_first) tell();
      image("/depth", t, test::flat(2000));
      if (!info_comes_first) tell();
    }
    const std::string place = address();
    const auto reading = read_all(place);
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), 11U);
    for (const Frame& frame : reading.frames)
      EXPECT_EQ(frame.intrinsics.fx(), frame.stamp < ms(500) ? 20.0 : 40.0);
    auto source = open_source(place);
    while ((*source)->next().value()) {
    }
    EXPECT_EQ((*source)->statistics()->cameras[0].intrinsics_changes, 1U);
    EXPECT_EQ((*source)->statistics()->cameras[0].intrinsics_changed, ms(500));
  }
}

TEST_F(BagChoice, knows_text_and_bags_by_their_content_whatever_their_names) {
  mount();
  info("/depth", test::info_message(24, 16, 20.0));
  std::string poses;
  for (int t = 0; t <= 1000; t += 50) {
    poses += fmt::format("{}.{:03} {} 0 1 0 0 0 1\n", 1'500'000'000 + t / 1000, t % 1000, 1e-3 * t);
    if (t % 100 == 0) image("/depth", t, test::flat(2000));
  }
  const std::string images = address();
  test::write_file(folder_ / "rig.yaml", "cameras: [{ at_m: [0, 0, 0] }]\n");
  const std::string rig = "?rig=" + (folder_ / "rig.yaml").string();
  for (const std::string name : {"poses.tum", "poses", "poses.csv"}) {
    test::write_file(folder_ / name, poses);
    const auto reading = read_all(images + "," + (folder_ / name).string() + rig);
    EXPECT_EQ(reading.error, "") << name;
    EXPECT_EQ(reading.frames.size(), 11U) << name;
  }
  bag_ = test::BagWriter();
  for (int t = 0; t <= 1000; t += 50) pose(t);
  bag_.end_chunk();
  test::write_file(folder_ / "poses.txt", bag_.bag());
  EXPECT_EQ(read_all(images + "," + (folder_ / "poses.txt").string() + rig).frames.size(), 11U)
      << "a bag whose name says text";
}

}  // namespace
}  // namespace swiftlet
