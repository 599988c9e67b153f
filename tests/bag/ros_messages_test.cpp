// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// One parser reads what ROS 1 and ROS 2 wrote: the law is that the same message comes out.

#include "swiftlet/bag/ros_messages.hpp"

#include <gtest/gtest.h>

#include "support/message_writer.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::MessageWriter;
using test::Wire;

constexpr std::int64_t kStamp_ns = 1'600'000'001'000'000'002;

SerializedMessage as_message(Wire wire, const std::string& bytes) {
  return {wire == Wire::kRos1 ? MessageEncoding::kRos1 : MessageEncoding::kCdr,
          std::as_bytes(std::span(bytes))};
}

class EveryWire : public ::testing::TestWithParam<Wire> {
 protected:
  /// A name of each length, so that what follows is aligned in each way.
  static std::vector<std::string> frames() {
    return {"", "a", "ab", "abc", "abcd", "abcde", "abcdef", "camera_depth_optical_frame"};
  }
  template <class Parse>
  auto parsed(const MessageWriter& writer, Parse&& parse) const {
    return parse(as_message(GetParam(), writer.text()));
  }
  [[nodiscard]] MessageWriter writer() const { return MessageWriter(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(RosMessages, EveryWire,
                         ::testing::Values(Wire::kRos1, Wire::kCdr, Wire::kCdrBigEndian,
                                           Wire::kCdr2));

TEST_P(EveryWire, gives_the_image_that_was_written) {
  for (const std::string& frame : frames()) {
    const auto bytes = writer()
                           .header({kStamp_ns}, frame)
                           .add(std::uint32_t{2})
                           .add(std::uint32_t{3})
                           .string("16UC1")
                           .add(std::uint8_t{1})
                           .add(std::uint32_t{6})
                           .bytes("123456789abc");
    const auto image = parsed(bytes, ros::parse_image);
    ASSERT_TRUE(image) << frame;
    EXPECT_EQ(image->header.stamp.ns, kStamp_ns);
    EXPECT_EQ(image->header.frame_id, frame);
    EXPECT_EQ(image->width, 3U);
    EXPECT_EQ(image->height, 2U);
    EXPECT_EQ(image->encoding, "16UC1");
    EXPECT_TRUE(image->is_big_endian);
    EXPECT_EQ(image->step, 6U);
    EXPECT_EQ(image->data.size(), 12U);
    EXPECT_EQ(image->data[11], std::byte{'c'});
  }
}

TEST_P(EveryWire, gives_the_camera_with_binning_and_region) {
  for (const std::string& frame : frames()) {
    auto bytes = writer();
    bytes.header({kStamp_ns}, frame).add(std::uint32_t{480}).add(std::uint32_t{640});
    bytes.string("plumb_bob").add(std::uint32_t{5});
    for (const double d : {0.1, 0.2, 0.3, 0.4, 0.5}) bytes.add(d);
    for (int k = 0; k < 9; ++k) bytes.add(100.0 + k);
    bytes.zeros<double>(21);
    for (const std::uint32_t value : {2U, 4U, 10U, 20U, 30U, 40U}) bytes.add(value);
    bytes.add(std::uint8_t{1});
    const auto info = parsed(bytes, ros::parse_camera_info);
    ASSERT_TRUE(info) << frame;
    EXPECT_EQ(info->D, (std::vector{0.1, 0.2, 0.3, 0.4, 0.5}));
    EXPECT_EQ(info->K[8], 108.0);
    EXPECT_EQ(info->binning_x, 2U);
    EXPECT_EQ(info->binning_y, 4U);
    EXPECT_EQ(info->region, (ros::Region{10, 20, 30, 40}));
  }
}

TEST_P(EveryWire, gives_the_cloud_that_was_written) {
  for (const std::string& frame : frames()) {
    auto bytes = writer();
    bytes.header({kStamp_ns}, frame).add(std::uint32_t{2}).add(std::uint32_t{1});
    bytes.structs(2);
    for (const char* name : {"x", "rgba"})
      bytes.string(name).add(std::uint32_t{4}).add(std::uint8_t{7}).add(std::uint32_t{1});
    bytes.end_structs();
    bytes.add(std::uint8_t{0}).add(std::uint32_t{8}).add(std::uint32_t{8});
    bytes.bytes("0123456789abcdef").add(std::uint8_t{1});
    const auto cloud = parsed(bytes, ros::parse_point_cloud);
    ASSERT_TRUE(cloud) << frame;
    EXPECT_EQ(cloud->fields.size(), 2U);
    EXPECT_EQ(cloud->fields[1].name, "rgba");
    EXPECT_EQ(cloud->fields[1].datatype, ros::PointField::kFloat32);
    EXPECT_EQ(cloud->data.size(), 16U);
  }
}

TEST_P(EveryWire, gives_the_poses_of_every_type) {
  const Eigen::Vector3d t_m(1.5, -2.5, 3.5);
  const Eigen::Quaterniond R(0.5, 0.5, -0.5, 0.5);
  for (const std::string& frame : frames()) {
    for (const std::string_view type : ros::kPoseTypes) {
      auto bytes = writer();
      const bool is_list = type.find("fMessage") != std::string_view::npos ||
                           type.find("TFMessage") != std::string_view::npos;
      const bool has_child = is_list || type.find("Odometry") != std::string_view::npos ||
                             type.find("TransformStamped") != std::string_view::npos;
      if (is_list) bytes.structs(2);
      for (int i = 0; i < (is_list ? 2 : 1); ++i) {
        bytes.header({kStamp_ns}, frame);
        if (has_child) bytes.string("base_link");
        bytes.pose(t_m, R);
      }
      if (is_list) bytes.end_structs();
      if (type == "nav_msgs/Odometry") bytes.zeros<double>(36 + 6 + 36);
      if (type == "geometry_msgs/PoseWithCovarianceStamped") bytes.zeros<double>(36);
      const auto poses = ros::parse_poses(type, as_message(GetParam(), bytes.text()));
      ASSERT_TRUE(poses) << type << " of '" << frame << "'";
      ASSERT_EQ(poses->size(), is_list ? 2U : 1U);
      EXPECT_EQ(poses->back().parent, frame);
      EXPECT_EQ(poses->back().child, has_child ? "base_link" : "");
      EXPECT_EQ(poses->back().pose.t_m, t_m);
      EXPECT_EQ(poses->back().pose.R.coeffs(), R.coeffs());
    }
  }
}

TEST_P(EveryWire, cut_at_any_byte_or_full_of_noise_does_no_harm) {
  const auto whole = writer()
                         .structs(1)
                         .header({kStamp_ns}, "odom")
                         .string("base_link")
                         .pose({1, 2, 3}, Eigen::Quaterniond::Identity())
                         .end_structs()
                         .text();
  const auto parse_all = [&](const std::string& bytes) {
    const SerializedMessage message = as_message(GetParam(), bytes);
    (void)ros::parse_image(message);
    (void)ros::parse_compressed_image(message);
    (void)ros::parse_point_cloud(message);
    (void)ros::parse_camera_info(message);
    for (const std::string_view type : ros::kPoseTypes) (void)ros::parse_poses(type, message);
  };
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    const std::string cut = whole.substr(0, bytes);
    EXPECT_FALSE(ros::parse_poses("tf2_msgs/TFMessage", as_message(GetParam(), cut))) << bytes;
    parse_all(cut);
  }
  test::for_each_seed(500, [&](test::Random& random) {
    std::string noisy = whole;
    for (int i = 0; i < 8; ++i)
      noisy[random.integer<std::size_t>(0, noisy.size() - 1)] =
          static_cast<char>(random.integer(0, 255));
    parse_all(noisy);
  });
}

TEST(RosMessages, before_1970_are_of_ros_2_alone) {
  const auto seconds_of = [](Wire wire) {
    const std::string bytes = MessageWriter(wire)
                                  .add(std::uint32_t{0xFFFFFFFF})
                                  .add(std::uint32_t{0})
                                  .string("f")
                                  .pose({0, 0, 0}, Eigen::Quaterniond::Identity())
                                  .text();
    const std::string ros1 = std::string(4, '\0') + bytes;
    return ros::parse_poses("geometry_msgs/PoseStamped",
                            as_message(wire, wire == Wire::kRos1 ? ros1 : bytes))
               ->front()
               .stamp.ns /
           1'000'000'000;
  };
  EXPECT_EQ(seconds_of(Wire::kCdr), -1);
  EXPECT_EQ(seconds_of(Wire::kRos1), 0xFFFFFFFFLL);
}

TEST(RosMessages, in_another_form_of_cdr_or_another_encoding_are_refused) {
  std::string bytes = MessageWriter(Wire::kCdr).add(1.0F).text();
  EXPECT_TRUE(ros::parse_float32(as_message(Wire::kCdr, bytes)));
  for (const char kind : {'\2', '\3', '\x0b', '\x40'}) {
    bytes[1] = kind;
    EXPECT_FALSE(ros::parse_float32(as_message(Wire::kCdr, bytes))) << int(kind);
  }
  EXPECT_FALSE(ros::parse_float32({MessageEncoding::kOther, std::as_bytes(std::span(bytes))}));
}

}  // namespace
}  // namespace swiftlet
