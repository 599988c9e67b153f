// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/support/run_program.hpp"
#include "support/bag_writer.hpp"
#include "support/recordings.hpp"

namespace swiftlet::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

#if SWIFTLET_HAS_EMBREE
TEST(CharacterizeFill, tells_how_readings_are_lost_as_a_wall_tilts) {
  const TempFolder folder;
  const auto rows =
      run_for_json({"characterize", "fill", "sim:tilt?rate=4", "-o", "fill", "--json"},
                   folder.path())
          .at("by_tilt_deg");
  ASSERT_GT(rows.size(), 10U);
  EXPECT_EQ(rows.front().at("tilt_deg"), 0.0);
  EXPECT_GT(rows.front().at("of_middle"), 0.99);
  EXPECT_LT(rows.back().at("of_middle"), 0.9) << "beyond 80 degrees of incidence matching fails";
  EXPECT_THAT(content_of(folder / "fill" / "fill_tilt_deg.csv"), HasSubstr("of its middle fifth,"));
}
#endif

/// A RealSense recording of a camera alone: images with exposure and laser power, without poses.
void write_sweep(const std::filesystem::path& path) {
  const std::string sensor = "/device_0/sensor_0", stream = sensor + "/Depth_0";
  const auto pair = [](std::string_view key, std::string_view value) {
    return Bytes().string(key).string(value).text();
  };
  BagWriter bag;
  bag.message("/file_version", "std_msgs/UInt32", Stamp{1}, Bytes().add(std::uint32_t{4}).text());
  bag.message(stream + "/info/camera_info", "sensor_msgs/CameraInfo", Stamp{1},
              info_message(24, 16, 20.0));
  for (int i = 0; i < 4; ++i) {
    const Stamp at{1'000'000 * (i + 1)};
    if (i == 2) {
      bag.message(sensor + "/option/Laser Power/value", "std_msgs/Float32", at,
                  Bytes().add(60.0F).text());
    }
    Image<std::uint16_t> image = flat(2000);
    for (int u = 0; u < 6 * (i % 2); ++u) {
      for (int v = 0; v < 16; ++v) image.at(u, v) = 0;
    }
    bag.message(stream + "/image/data", "sensor_msgs/Image", at,
                image_message(image, at, "mono16", "0"));
    bag.message(stream + "/image/metadata", "diagnostic_msgs/KeyValue", at,
                pair("Actual Exposure", i % 2 == 0 ? "8500" : "33000"));
    if (i == 3) {
      bag.message(stream + "/image/metadata", "diagnostic_msgs/KeyValue", at,
                  pair("Frame Laser Power", "150"));
    }
  }
  bag.end_chunk();
  write_file(path, bag.bag());
}

TEST(CharacterizeFill, reads_exposure_and_laser_power_from_a_recording_without_poses) {
  const TempFolder folder;
  write_sweep(folder / "sweep.bag");
  const auto json =
      run_for_json({"characterize", "fill", "bag:sweep.bag", "--json"}, folder.path());
  EXPECT_EQ(json.at("frames"), 4);
  const auto& exposure = json.at("by_exposure_ms");
  ASSERT_EQ(exposure.size(), 2U);
  EXPECT_EQ(exposure[0].at("exposure_ms"), 8.5);
  EXPECT_EQ(exposure[0].at("valid_pixels"), 24 * 16);
  EXPECT_EQ(exposure[1].at("exposure_ms"), 33.0);
  EXPECT_EQ(exposure[1].at("of_image"), 0.75);
  const auto& laser = json.at("by_laser_mw");
  ASSERT_EQ(laser.size(), 2U) << "of the sensor's option, and where a frame tells its own, that";
  EXPECT_EQ(laser[0].at("laser_mw"), 60.0);
  EXPECT_EQ(laser[1].at("laser_mw"), 150.0);
  const Ended table = run({"characterize", "fill", "bag:sweep.bag"}, folder.path());
  EXPECT_THAT(table.out, AllOf(HasSubstr("exposure [ms]"), HasSubstr("75.0 %")));
}

}  // namespace
}  // namespace swiftlet::test
