// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Writes the seeds of the fuzzer into the folder that is named: small bags of both kinds, packed
// and not, each with every message that is looked into.

#include <filesystem>

#include "support/bag_writer.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace swiftlet;
using test::Bytes;

const Image<std::uint16_t> kImage(4, 3, 1000);
Stamp ms(int value) { return Stamp{1'600'000'000'000'000'000} + std::chrono::milliseconds(value); }

std::string pair(std::string_view key, std::string_view value) {
  return Bytes().string(key).string(value).text();
}

std::string ros_bag(const std::string& compression) {
  test::BagWriter bag(compression);
  bag.message("/tf_static", "tf2_msgs/TFMessage", ms(0),
              test::tf_message(ms(0), "base_link", "depth_optical", {0.1, 0, 0}));
  bag.message("/d/camera_info", "sensor_msgs/CameraInfo", ms(0), test::info_message(4, 3, 3.0));
  for (const int t : {0, 33}) {
    bag.message("/odom", "nav_msgs/Odometry", ms(t),
                test::odometry_message(ms(t), {0.001 * t, 0, 0}));
    bag.message("/tf", "tf2_msgs/TFMessage", ms(t),
                test::tf_message(ms(t), "world", "base_link", {0.001 * t, 0, 0}));
    bag.message("/d/image", "sensor_msgs/Image", ms(t), test::image_message(kImage, ms(t)));
    bag.end_chunk();
  }
  return bag.bag();
}

std::string realsense_bag(const std::string& compression) {
  test::BagWriter bag(compression);
  const Stamp start{1};
  const std::string sensor = "/device_0/sensor_0", depth = sensor + "/Depth_0/";
  const std::string pose = "/device_0/sensor_1/Pose_0/pose/";
  bag.message("/file_version", "std_msgs/UInt32", start, Bytes().add(std::uint32_t{4}).text());
  bag.message(depth + "info/camera_info", "sensor_msgs/CameraInfo", start,
              test::info_message(4, 3, 3.0));
  bag.message(sensor + "/option/Depth Units/value", "std_msgs/Float32", start,
              Bytes().add(0.001F).text());
  bag.message(sensor + "/option/Stereo_Baseline/value", "std_msgs/Float32", start,
              Bytes().add(50.0F).text());
  for (const int t : {0, 5, 10}) {
    const Stamp at{1000 + t};
    bag.message(pose + "transform/data", "geometry_msgs/Transform", at,
                Bytes().pose({0.001 * t, 0, 0}, Eigen::Quaterniond::Identity()).text());
    for (const auto& [key, value] :
         {std::pair("Tracker Confidence", "3"), std::pair("timestamp_domain", "Global Time"),
          std::pair("frame_timestamp", t == 5 ? "0x1.7p+40" : "1600000000000.000000")})
      bag.message(pose + "metadata", "diagnostic_msgs/KeyValue", at, pair(key, value));
    bag.message(depth + "image/data", "sensor_msgs/Image", at,
                test::image_message(kImage, ms(t), "mono16", "1") + Bytes().add(0.001F).text());
    for (const auto& [key, value] :
         {std::pair("timestamp_domain", "Global Time"), std::pair("Frame Timestamp", "9000"),
          std::pair("Sensor Timestamp", "5000")})
      bag.message(depth + "image/metadata", "diagnostic_msgs/KeyValue", at, pair(key, value));
    bag.end_chunk();
  }
  return bag.bag();
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const std::filesystem::path folder(words[1]);
  for (const std::string compression : {"none", "lz4"}) {
    test::write_file(folder / ("ros_" + compression + ".bag"), ros_bag(compression));
    test::write_file(folder / ("realsense_" + compression + ".bag"), realsense_bag(compression));
  }
  return 0;
}
