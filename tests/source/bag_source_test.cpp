// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/bag_writer.hpp"
#include "support/recordings.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::Bytes;
using test::read_all;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Stamp kStart{1'500'000'000'000'000'000};
Stamp ms(int value) { return kStart + std::chrono::milliseconds(value); }
Eigen::Vector3d place(int t_ms) { return {1e-3 * t_ms, 0.0, 1.0}; }

const Eigen::Quaterniond kLooksForward = forward_looking_camera().rotation();

/// A rig on ROS: images every 33 ms, odometry every 10 ms, the mount in /tf_static; the vehicle
/// flies along x at 1 m/s.
struct RosRig {
  std::string compression = "lz4";
  std::string encoding = "16UC1";
  bool has_mount = true;
  bool is_sorted_by_topic = false;  // as tools leave bags that merge others

  void write(const std::filesystem::path& path) const {
    test::BagWriter bag(compression);
    if (has_mount) {
      bag.message("/tf_static", "tf2_msgs/TFMessage", kStart,
                  test::tf_message(kStart, "/base_link", "camera_link", {0.1, 0.0, 0.05}));
      bag.message("/tf_static", "tf2_msgs/TFMessage", kStart,
                  test::tf_message(kStart, "camera_link", "depth_optical", {0.0, 0.02, 0.0},
                                   kLooksForward));
    }
    bag.message("/cam/depth/camera_info", "sensor_msgs/CameraInfo", kStart,
                test::info_message(24, 16, 20.0));
    for (const bool with_images : {true, false}) {
      for (int t = 0; t <= 500; ++t) {
        const bool both = !is_sorted_by_topic;
        if ((both || with_images) && t % 33 == 0) image(bag, t);
        if ((both || !with_images) && t % 10 == 0)
          bag.message("/odom", "nav_msgs/Odometry", ms(t), test::odometry_message(ms(t), place(t)));
      }
      if (!is_sorted_by_topic) break;
    }
    bag.end_chunk();
    test::write_file(path, bag.bag());
  }

 private:
  void image(test::BagWriter& bag, int t) const {
    bag.message("/cam/depth/image_raw", "sensor_msgs/Image", ms(t),
                test::image_message(test::flat(2000), ms(t), encoding));
    if (t % 99 == 0) bag.end_chunk();
  }
};

std::string in_bag(const test::TempFolder& folder, const RosRig& rig) {
  rig.write(folder / "rig.bag");
  return "bag:" + (folder / "rig.bag").string();
}

TEST(BagSource, joins_images_and_odometry_of_a_ros_bag_by_time_and_its_own_mount) {
  const test::TempFolder folder;
  const auto reading = read_all(in_bag(folder, {}));
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 16U);
  for (const Frame& frame : reading.frames) {
    const double t_s = seconds(frame.stamp - kStart);
    const Eigen::Vector3d expected(t_s + 0.1, 0.02, 1.05);
    EXPECT_LT((frame.T_world_camera.translation() - expected).norm(), 1e-9);
    EXPECT_LT(frame.T_world_camera.rotation().angularDistance(kLooksForward), 1e-7);
    EXPECT_EQ(frame.depth.raw.at(3, 4), 2000);
    EXPECT_EQ(frame.intrinsics.fx(), 20.0);
  }
}

TEST(BagSource, reads_the_same_whatever_the_packing_and_the_order_of_the_topics) {
  const test::TempFolder folder;
  const auto reference = read_all(in_bag(folder, {}));
  for (const RosRig& rig : {RosRig{.compression = "none"}, RosRig{.is_sorted_by_topic = true},
                            RosRig{.encoding = "mono16"}}) {
    const auto reading = read_all(in_bag(folder, rig));
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), reference.frames.size());
    for (std::size_t i = 0; i < reading.frames.size(); ++i) {
      EXPECT_EQ(reading.frames[i].stamp, reference.frames[i].stamp);
      EXPECT_EQ(reading.frames[i].T_world_camera.translation(),
                reference.frames[i].T_world_camera.translation());
    }
  }
}

TEST(BagSource, takes_the_mount_of_the_rig_file_before_that_of_the_bag) {
  const test::TempFolder folder;
  test::write_file(folder / "rig.yaml", "cameras:\n  - { at_m: [0, 0, 0.5], yaw_deg: 90 }\n");
  const auto reading =
      read_all(in_bag(folder, {.has_mount = false}) + "?rig=" + (folder / "rig.yaml").string());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 16U);
  EXPECT_NEAR(reading.frames[0].T_world_camera.translation().z(), 1.5, 1e-9);
  const Eigen::Vector3d looks =
      reading.frames[0].T_world_camera.rotation() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((looks - Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

TEST(BagSource, says_what_is_missing_and_what_to_do) {
  const test::TempFolder folder;
  EXPECT_THAT(read_all(in_bag(folder, {.has_mount = false})).error,
              AllOf(HasSubstr("/tf_static"), HasSubstr("'depth_optical'"), HasSubstr("--rig")));
  const std::string good = in_bag(folder, {});
  EXPECT_THAT(read_all(good + "?depth_topic=/nope").error,
              AllOf(HasSubstr("/nope"), HasSubstr("/cam/depth/image_raw")));
  EXPECT_THAT(read_all(good + "?info_topic=/nope").error, HasSubstr("no CameraInfo on /nope"));
  EXPECT_THAT(read_all(good + "?pose_topic=/nope").error, HasSubstr("/odom"));
  EXPECT_THAT(read_all(good + "?pose_topic=/tf_static").error, HasSubstr("--body-frame"));
  for (const std::string bad :
       {"?pairing=guess", "?on_jump=panic", "?colour=red", "?pose_axes=up", "?depth_unit_m=0",
        "?pose_offset_ms=nan", "?rig=/no/rig.yaml", "?pairing", "?on_jump=keep&on_jump=keep"}) {
    EXPECT_NE(read_all(good + bad).error, "") << bad;
  }
  EXPECT_THAT(read_all(good + "," + (folder / "rig.bag").string() + ",x.bag").error,
              HasSubstr("2 files with depth for 1 cameras"));
}

TEST(BagSource, reads_poses_of_a_tf_topic_for_the_frame_that_is_named) {
  const test::TempFolder folder;
  test::BagWriter bag;
  for (int t = 0; t <= 500; t += 10) {
    bag.message("/tf", "tf2_msgs/TFMessage", ms(t),
                test::tf_message(ms(t), "base_link", "propeller", {9, 9, 9}));
    bag.message("/tf", "tf2_msgs/TFMessage", ms(t),
                test::tf_message(ms(t), "world", "base_link", place(t)));
  }
  bag.end_chunk();
  test::write_file(folder / "tf.bag", bag.bag());
  const auto reading = read_all(in_bag(folder, {}) + "," + (folder / "tf.bag").string() +
                                "?pose_topic=/tf&body_frame=base_link");
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 16U);
  EXPECT_NEAR(reading.frames[3].T_world_camera.translation().x(), 0.199, 1e-9);
}

/// A bag of one image of 32FC1.
std::string float_image(std::uint8_t is_big_endian, const std::vector<float>& depths_m) {
  Bytes bytes;
  bytes.header(0, ms(0), "depth_optical").add(std::uint32_t{1});
  bytes.add(static_cast<std::uint32_t>(depths_m.size())).string("32FC1").add(is_big_endian);
  bytes.add(static_cast<std::uint32_t>(4 * depths_m.size()));
  Bytes data;
  for (const float z : depths_m) {
    std::string raw = Bytes().add(z).text();
    if (is_big_endian != 0) std::reverse(raw.begin(), raw.end());
    data.raw(raw);
  }
  return bytes.string(data.text()).text();
}

TEST(BagSource, turns_metres_into_steps_and_what_is_no_depth_into_none) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const std::vector<float> depths_m{1.5F,  0.0F,    std::nanf(""), kInf,
                                    -1.0F, 65.535F, 66.0F,         0.0004F};
  const std::vector<std::uint16_t> expected{1500, 0, 0, 0, 0, 65535, 0, 0};
  for (const std::uint8_t is_big_endian : {std::uint8_t{0}, std::uint8_t{1}}) {
    const test::TempFolder folder;
    test::BagWriter bag;
    bag.message("/tf_static", "tf2_msgs/TFMessage", kStart,
                test::tf_message(kStart, "base_link", "depth_optical", {0, 0, 0}));
    bag.message("/d/camera_info", "sensor_msgs/CameraInfo", kStart, test::info_message(8, 1, 20.0));
    bag.message("/d/image", "sensor_msgs/Image", ms(0), float_image(is_big_endian, depths_m));
    bag.message("/odom", "nav_msgs/Odometry", ms(0), test::odometry_message(ms(0), place(0)));
    bag.end_chunk();
    test::write_file(folder / "f.bag", bag.bag());
    const auto reading = read_all("bag:" + (folder / "f.bag").string());
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), 1U);
    const auto pixels = reading.frames[0].depth.raw.pixels();
    EXPECT_EQ(std::vector<std::uint16_t>(pixels.begin(), pixels.end()), expected);
  }
}

TEST(BagSource, refuses_images_with_lens_distortion_or_of_another_size) {
  const auto error_with = [](const std::string& info, const std::string& image) {
    const test::TempFolder folder;
    test::BagWriter bag;
    bag.message("/tf_static", "tf2_msgs/TFMessage", kStart,
                test::tf_message(kStart, "base_link", "depth_optical", {0, 0, 0}));
    bag.message("/d/camera_info", "sensor_msgs/CameraInfo", kStart, info);
    bag.message("/d/image", "sensor_msgs/Image", ms(0), image);
    bag.message("/odom", "nav_msgs/Odometry", ms(0), test::odometry_message(ms(0), place(0)));
    bag.end_chunk();
    test::write_file(folder / "d.bag", bag.bag());
    return read_all("bag:" + (folder / "d.bag").string()).error;
  };
  const std::string image = test::image_message(test::flat(1), ms(0));
  EXPECT_EQ(error_with(test::info_message(24, 16, 20.0), image), "");
  EXPECT_THAT(error_with(test::info_message(24, 16, 20.0, {0.1, 0, 0, 0, 0}), image),
              HasSubstr("distortion"));
  EXPECT_THAT(error_with(test::info_message(24, 17, 20.0), image), HasSubstr("another size"));
  EXPECT_THAT(error_with(test::info_message(24, 16, 0.0), image), HasSubstr("d.bag"));
  EXPECT_THAT(error_with(test::info_message(24, 16, 20.0), image.substr(0, image.size() - 1)),
              HasSubstr("no depth images"));
}

TEST(BagSource, gives_every_frame_before_the_damage_and_then_says_where_it_is) {
  const test::TempFolder folder;
  const std::string address = in_bag(folder, {});
  const auto whole = read_all(address);
  const std::string bytes = test::content_of(folder / "rig.bag");
  std::size_t most = 0;
  for (std::size_t cut = 1000; cut < bytes.size(); cut += 97) {
    test::write_file(folder / "rig.bag", std::string_view(bytes).substr(0, cut));
    const auto reading = read_all(address);
    EXPECT_NE(reading.error, "") << cut;
    EXPECT_GE(reading.frames.size(), most);
    most = reading.frames.size();
  }
  EXPECT_GT(most, whole.frames.size() / 2);
}

}  // namespace
}  // namespace swiftlet
