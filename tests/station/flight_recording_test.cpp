// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/flight/flight_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "station/station_world.hpp"
#include "support/synthetic.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/bag/ros_messages.hpp"

namespace swiftlet::station {
namespace {

/// Frames a tenth of a second apart.
std::vector<Frame> small_flight(test::Random& random, int count) {
  std::vector<Frame> frames;
  for (int i = 1; i <= count; ++i) {
    frames.push_back(test::random_frame(random, test::small_camera()));
    frames.back().stamp = Stamp{i * 100'000'000LL};
  }
  return frames;
}

/// What of a recording a test looks at.
struct RecordedFlight {
  RecordingInfo info;
  std::vector<std::vector<std::byte>> images{};  // their pixels
  std::vector<Eigen::Vector3d> positions_m{};
  std::map<std::string, std::size_t> counts{};  // messages by topic
  std::uint64_t occupied = 0;                   // points of the last cloud
};

RecordedFlight read_flight(const std::filesystem::path& path) {
  RecordedFlight flight;
  auto reader = open_recording(path);
  EXPECT_TRUE(reader) << reader.error().text();
  while (reader) {
    const auto message = (*reader)->next();
    EXPECT_TRUE(message) << message.error().text();
    if (!message || !*message) break;
    const BagConnection& topic = *(*message)->connection;
    const SerializedMessage bytes = (*message)->serialized();
    ++flight.counts[topic.topic];
    if (topic.type == "sensor_msgs/Image") {
      const auto image = ros::parse_image(bytes);
      EXPECT_TRUE(image && image->encoding == "16UC1");
      if (image) flight.images.emplace_back(image->data.begin(), image->data.end());
    }
    if (topic.type == "nav_msgs/Odometry") {
      const auto poses = ros::parse_poses(topic.type, bytes);
      EXPECT_TRUE(poses);
      if (poses) flight.positions_m.push_back(poses->front().pose.t_m);
    }
    if (topic.topic != "/map/occupied") continue;
    const auto cloud = ros::parse_point_cloud(bytes);
    EXPECT_TRUE(cloud);
    if (cloud) flight.occupied = std::uint64_t{cloud->width} * cloud->height;
  }
  if (reader) flight.info = (*reader)->info();
  return flight;
}

TEST(FlightRecording, holds_every_frame_as_it_came_and_the_map_at_the_end) {
  const test::TempFolder folder;
  test::Random random;
  RandomFlight flight(random);
  const std::vector<Frame> frames = small_flight(random, 40);
  auto recording = FlightRecording::start(folder / "f.mcap", flight.feed, {{"source", "test"}});
  ASSERT_TRUE(recording) << recording.error().text();
  for (const Frame& frame : frames) {
    flight.step();
    (*recording)->add(frame);
  }
  const Status closed = (*recording)->close();
  ASSERT_TRUE(closed) << closed.error().text();
  EXPECT_EQ((*recording)->missed(), 0U) << "nobody is in a hurry";

  const RecordedFlight read = read_flight(folder / "f.mcap");
  EXPECT_EQ(read.info.format, "MCAP, profile ros2");
  EXPECT_TRUE(read.info.is_closed);
  ASSERT_EQ(read.images.size(), frames.size());
  ASSERT_EQ(read.positions_m.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto pixels = std::as_bytes(frames[i].depth.raw.pixels());
    ASSERT_EQ(read.images[i].size(), pixels.size());
    EXPECT_EQ(std::memcmp(read.images[i].data(), pixels.data(), pixels.size()), 0);
    EXPECT_EQ(read.positions_m[i], frames[i].T_world_camera.translation());
  }
  EXPECT_EQ(read.counts.at("/tf"), frames.size());
  EXPECT_EQ(read.counts.at("/camera/depth/camera_info"), frames.size());
  EXPECT_GE(read.counts.at("/map/changes"), 2U);
  EXPECT_GE(read.counts.at("/path"), 2U);
  EXPECT_GE(read.counts.at("/statistics"), 2U);
  EXPECT_EQ(read.occupied, flight.truth().occupied) << random.repeat();
}

TEST(FlightRecording, that_cannot_be_written_is_told_and_holds_nobody_up) {
  test::Random random;
  RandomFlight flight(random);
  EXPECT_FALSE(FlightRecording::start("/no/such/folder/f.mcap", flight.feed, {}));
  auto recording = FlightRecording::start("/dev/full", flight.feed, {});
  if (recording) {  // what is small is written later
    for (const Frame& frame : small_flight(random, 40)) (*recording)->add(frame);
    EXPECT_FALSE((*recording)->close());
  }
}

}  // namespace
}  // namespace swiftlet::station
