// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "support/bag_writer.hpp"
#include "support/recordings.hpp"

namespace swiftlet {
namespace {

using test::read_all;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Stamp kTfStart{1'600'000'000'000'000'000};
Stamp at_ms(int value) { return kTfStart + std::chrono::milliseconds(value); }

Eigen::Quaterniond turned(double yaw_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

/// How a drift correction grows: map to odom.
Transform<World, Body> correction(int t_ms) {
  return Transform<World, Body>::trusted(turned(2e-4 * t_ms), {1e-3 * t_ms, 0, 0});
}
/// And how the vehicle flies in odom.
Eigen::Vector3d in_odom(int t_ms) { return {2e-3 * t_ms, 0.5, 1.0}; }

/// A recording of ROS with an image every 50 ms, a mount in /tf_static, odometry in /tf every 10 ms
/// and a correction of its drift every 250 ms; a test takes something away.
class TfPoses : public ::testing::Test {
 protected:
  void fixed(const std::string& parent, const std::string& child, const Eigen::Vector3d& t_m,
             const std::string& topic = "/tf_static") {
    bag_.message(topic, "tf2_msgs/TFMessage", at_ms(0),
                 test::tf_message(at_ms(0), parent, child, t_m));
  }
  void tf(int t_ms, const std::string& parent, const std::string& child, const Eigen::Vector3d& t_m,
          double yaw_rad = 0.0) {
    bag_.message("/tf", "tf2_msgs/TFMessage", at_ms(t_ms),
                 test::tf_message(at_ms(t_ms), parent, child, t_m, turned(yaw_rad)));
  }
  void correct(int t_ms) { tf(t_ms, "map", "odom", correction(t_ms).translation(), 2e-4 * t_ms); }
  void camera() {
    bag_.message("/depth/camera_info", "sensor_msgs/CameraInfo", at_ms(0),
                 test::info_message(24, 16, 20.0));
  }
  void image(int t_ms) {
    bag_.message("/depth/image_raw", "sensor_msgs/Image", at_ms(t_ms),
                 test::image_message(test::flat(2000), at_ms(t_ms), "16UC1"));
  }
  void fly(int last_correction_ms = 1000) {
    camera();
    for (int t = 0; t <= 1000; t += 10) {
      tf(t, "odom", "base_footprint", in_odom(t));
      if (t % 50 == 0) image(t);
      if (t % 250 == 0 && t <= last_correction_ms) correct(t);
    }
  }
  std::string address(const std::string& options = "") {
    bag_.end_chunk();
    test::write_file(folder_ / "tf.bag", bag_.bag());
    return "bag:" + (folder_ / "tf.bag").string() + options;
  }

  test::TempFolder folder_;
  test::BagWriter bag_;
};

TEST_F(TfPoses, goes_through_the_whole_tree_and_interpolates_each_tie) {
  fixed("/base_footprint", "base_link", {0, 0, 0.2});
  fixed("base_link", "depth_optical", {0.1, 0, 0});
  fly();
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 21U);
  for (const Frame& frame : reading.frames) {
    const int t_ms = static_cast<int>((frame.stamp - kTfStart) / std::chrono::milliseconds(1));
    const Eigen::Vector3d expected =
        correction(t_ms) * (in_odom(t_ms) + Eigen::Vector3d(0.1, 0, 0.2));
    EXPECT_LT((frame.T_world_camera.translation() - expected).norm(), 1e-9) << t_ms;
    EXPECT_LT(frame.T_world_camera.rotation().angularDistance(turned(2e-4 * t_ms)), 1e-7) << t_ms;
  }
}

TEST_F(TfPoses, gives_the_same_for_any_frame_of_the_chain_that_is_called_the_vehicle) {
  fixed("base_footprint", "base_link", {0, 0, 0.2});
  fixed("base_link", "depth_optical", {0.1, 0, 0});
  fly();
  const auto reference = read_all(address());
  for (const std::string body : {"base_footprint", "/base_link", "depth_optical"}) {
    const auto reading = read_all(address("?body_frame=" + body));
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), reference.frames.size()) << body;
    for (std::size_t i = 0; i < reading.frames.size(); ++i) {
      EXPECT_LT((reading.frames[i].T_world_camera.translation() -
                 reference.frames[i].T_world_camera.translation())
                    .norm(),
                1e-9)
          << body;
    }
  }
}

TEST_F(TfPoses, stops_at_the_frame_that_is_called_the_world) {
  fixed("base_footprint", "depth_optical", {0, 0, 0});
  fly();
  const auto reading = read_all(address("?world_frame=/odom"));
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 21U);
  EXPECT_LT((reading.frames[20].T_world_camera.translation() - in_odom(1000)).norm(), 1e-9);
  EXPECT_THAT(read_all(address("?world_frame=earth")).error,
              AllOf(HasSubstr("'earth'"), HasSubstr("'map'")));
}

TEST_F(TfPoses, keeps_a_tie_that_falls_silent_as_it_was_last) {
  fixed("base_footprint", "depth_optical", {0, 0, 0});
  fly(500);
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 21U);
  const Eigen::Vector3d expected = correction(500) * in_odom(1000);
  EXPECT_LT((reading.frames[20].T_world_camera.translation() - expected).norm(), 1e-9);
}

TEST_F(TfPoses, gives_what_waits_for_a_correction_before_the_damage_of_a_file) {
  fixed("base_footprint", "depth_optical", {0, 0, 0});
  fly(0);
  bag_.end_chunk();
  const std::size_t whole = bag_.bag().size();
  image(1100);
  bag_.end_chunk();
  test::write_file(folder_ / "cut.bag", bag_.bag().substr(0, whole + 100));
  const auto reading = read_all("bag:" + (folder_ / "cut.bag").string());
  EXPECT_THAT(reading.error, HasSubstr("cut.bag"));
  EXPECT_EQ(reading.frames.size(), 21U);
}

TEST_F(TfPoses, leaves_out_what_lies_before_the_first_of_a_tie) {
  fixed("base_footprint", "depth_optical", {0, 0, 0});
  camera();
  for (int t = 0; t <= 4000; t += 10) {
    tf(t, "odom", "base_footprint", in_odom(t));
    if (t % 50 == 0) image(t);
    if (t % 250 == 0 && t >= 3000) correct(t);
  }
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_FALSE(reading.frames.empty());
  EXPECT_EQ(reading.frames.front().stamp, at_ms(3000));
  EXPECT_EQ(reading.frames.back().stamp, at_ms(4000));
}

TEST_F(TfPoses, survives_a_clock_that_is_set_back) {
  fixed("base_footprint", "depth_optical", {0, 0, 0});
  camera();
  for (const int offset : {60'000, 0}) {
    for (int t = 0; t <= 1000; t += 10) {
      tf(offset + t, "odom", "base_footprint", in_odom(t));
      if (t % 50 == 0) image(offset + t);
      if (t % 250 == 0) tf(offset + t, "map", "odom", {0, 0, offset == 0 ? 1.0 : 2.0});
    }
  }
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_GT(reading.frames.size(), 38U);
  for (std::size_t i = 0; i < reading.frames.size(); ++i) {
    const double expected_z = i <= 20 ? 3.0 : 2.0;
    EXPECT_NEAR(reading.frames[i].T_world_camera.translation().z(), expected_z, 1e-9) << i;
  }
}

TEST_F(TfPoses, takes_static_ties_that_are_repeated_on_tf_as_ROS_1_does) {
  camera();
  for (int t = 0; t <= 1000; t += 10) {
    tf(t, "odom", "base_link", in_odom(t));
    tf(t, "base_link", "depth_optical", {0.1, 0, 0});
    if (t % 50 == 0) image(t);
  }
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 21U);
  EXPECT_NEAR(reading.frames[20].T_world_camera.translation().x(), 2.1, 1e-9);
}

TEST_F(TfPoses, says_what_the_tree_lacks) {
  fixed("base_link", "depth_optical", {0, 0, 0});
  camera();
  image(0);
  EXPECT_THAT(read_all(address()).error,
              AllOf(HasSubstr("nothing of tf moves"), HasSubstr("'depth_optical'")));
  tf(10, "base_link", "odom", {0, 0, 0});  // a ring has no world
  tf(10, "odom", "base_link", {0, 0, 0});
  EXPECT_THAT(read_all(address()).error, HasSubstr("a ring"));
  EXPECT_THAT(read_all(address("?body_frame=odon")).error,
              AllOf(HasSubstr("no frame odon"), HasSubstr("did you mean odom?")));
}

TEST_F(TfPoses, counts_a_transform_that_is_none_and_goes_on) {
  fixed("base_footprint", "depth_optical", {0, 0, 0});
  fly();
  tf(1005, "odom", "base_footprint", {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  tf(1010, "odom", "base_footprint", in_odom(1010));
  image(1010);
  correct(1020);
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 22U);
  EXPECT_TRUE(reading.frames.back().T_world_camera.translation().allFinite());
}

TEST_F(TfPoses, takes_a_frame_with_a_slash_for_the_one_without) {
  for (const std::string written : {"base_link", "/base_link"}) {
    for (const std::string asked : {"base_link", "/base_link"}) {
      bag_ = test::BagWriter();
      fixed(written, "depth_optical", {0, 0, 0});
      camera();
      for (int t = 0; t <= 1000; t += 50) {
        tf(t, "odom", "propeller", in_odom(t));
        tf(t, "odom", written, in_odom(t));
        if (t % 100 == 0) image(t);
      }
      const auto reading = read_all(address("?pose_topic=tf&body_frame=" + asked));
      EXPECT_EQ(reading.error, "") << written << " " << asked;
      EXPECT_EQ(reading.frames.size(), 11U) << written << " " << asked;
    }
  }
}

TEST_F(TfPoses, asks_which_frame_of_tf_is_the_vehicle_where_a_rig_file_tells_the_mount) {
  test::write_file(folder_ / "rig.yaml", "cameras:\n  - { at_m: [0, 0, 0.5] }\n");
  fixed("base_link", "depth_optical", {0, 0, 0});
  for (int t = 0; t <= 1000; t += 50)
    tf(t, "odom", t % 100 == 0 ? "base_link" : "camera_link", in_odom(t));
  camera();
  image(0);
  const std::string rig = "?rig=" + (folder_ / "rig.yaml").string();
  EXPECT_THAT(read_all(address(rig)).error,
              AllOf(HasSubstr("--body-frame"), HasSubstr("base_link, camera_link")));
  EXPECT_EQ(read_all(address(rig + "&body_frame=base_link")).error, "");
}

}  // namespace
}  // namespace swiftlet
