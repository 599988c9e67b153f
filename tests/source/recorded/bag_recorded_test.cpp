// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Recordings written by three versions of the RealSense SDK, one of a real D435 and one of a real
// T265; their README.txt tells by formulas what each holds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/map_bits.hpp"
#include "support/recorded.hpp"
#include "support/recordings.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"
#include "swiftlet/source/depth_png.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t kT0_ns = 1'600'000'000'000'000'000;
constexpr double kStampStep_ns = 240.0;  // the SDK passes stamps through a double of seconds

std::string bag(const std::string& name) { return (test::recorded_folder("bags") / name).string(); }

std::uint16_t sim_pixel(int u, int v, int k) {
  if (u == 0 && v == 0) return static_cast<std::uint16_t>(k + 1);
  if (u == 847 && v == 479) return static_cast<std::uint16_t>(60000 + k);
  if (u < 40 || (u + 2 * v + 3 * k) % 37 == 0) return 0;
  return static_cast<std::uint16_t>(800 + (u + 2 * v) % 1024 + 20 * k);
}

/// Reads the depth stream of a bag and holds each image against the "sim" scene.
std::size_t check_sim_images(const std::string& file, ClockDomain clock, float unit_m) {
  auto depth = open_bag_depth(bag(file), {});
  EXPECT_TRUE(depth) << depth.error().text();
  if (!depth) return 0;
  EXPECT_EQ(depth->intrinsics,
            PinholeIntrinsics::create(848, 480, 425.5, 425.25, 423.25, 240.75).value());
  int k = 0;
  for (;; ++k) {
    const auto frame = depth->stream->next();
    EXPECT_TRUE(frame) << frame.error().text();
    if (!frame || !*frame) break;
    const double expected_ns = k * 1e9 / 30.0;
    EXPECT_NEAR(static_cast<double>((*frame)->stamp.ns - kT0_ns), expected_ns, kStampStep_ns);
    EXPECT_EQ((*frame)->clock, clock);
    EXPECT_EQ((*frame)->depth.unit_m, unit_m);
    int wrong = 0;
    for (int v = 0; v < 480; ++v)
      for (int u = 0; u < 848; ++u)
        wrong += (*frame)->depth.raw.at(u, v) == sim_pixel(u, v, k) ? 0 : 1;
    EXPECT_EQ(wrong, 0) << "image " << k;
  }
  return static_cast<std::size_t>(k);
}

/// Reads the pose stream of a bag and holds each pose against the "sim" path, in the T265's axes
/// turned into ours: x = -z, y = -x, z = y.
std::size_t check_sim_poses(const std::string& file, double first_ms) {
  auto poses = open_bag_poses(bag(file), {});
  EXPECT_TRUE(poses) << poses.error().text();
  if (!poses) return 0;
  EXPECT_TRUE(poses->is_t265);
  int i = 0;
  for (;; ++i) {
    const auto pose = poses->stream->next();
    EXPECT_TRUE(pose) << pose.error().text();
    if (!pose || !*pose) break;
    const double s = 0.005 * i;
    const double expected_ns = (first_ms + 5.0 * i) * 1e6;
    EXPECT_NEAR(static_cast<double>((*pose)->stamp.ns - kT0_ns), expected_ns, kStampStep_ns);
    const Eigen::Vector3d t_m(0.30 * s, -0.10 * s, 0.02 * std::sin(2 * M_PI * s));
    EXPECT_LT(((*pose)->t_world_body_m - t_m).norm(), 1e-6) << i;
    const Eigen::Quaterniond R(Eigen::AngleAxisd(0.5 * s, Eigen::Vector3d::UnitZ()));
    EXPECT_LT((*pose)->R_world_body.angularDistance(R), 1e-6) << i;
    EXPECT_EQ((*pose)->clock, ClockDomain::kGlobal);
  }
  return static_cast<std::size_t>(i);
}

class Bags : public ::testing::Test {
 protected:
  void SetUp() override { SWIFTLET_NEEDS_RECORDING(test::recorded_folder("bags")); }
};

TEST_F(Bags, of_every_sdk_hold_exactly_the_depth_their_readme_tells) {
  for (const std::string file : {"d435_t265_v2.53.1.bag", "pipeline_recorded_v2.53.1.bag",
                                 "d435_only_v2.53.1.bag", "d435_t265_v2.57.2.bag"}) {
    SCOPED_TRACE(file);
    EXPECT_EQ(check_sim_images(file, ClockDomain::kGlobal, 0.001F), 10U);
  }
  EXPECT_EQ(check_sim_images("d435_depth_sdk2.13.bag", ClockDomain::kSystem, 0.001F), 10U);
  EXPECT_EQ(check_sim_images("uncompressed_2depth_v2.53.1.bag", ClockDomain::kGlobal, 0.001F), 2U);
  EXPECT_EQ(check_sim_images("tf_v2.53.1.bag", ClockDomain::kGlobal, 0.0001F), 2U);
}

TEST_F(Bags, of_every_sdk_hold_exactly_the_poses_their_readme_tells) {
  for (const std::string file :
       {"d435_t265_v2.53.1.bag", "pipeline_recorded_v2.53.1.bag", "d435_t265_v2.57.2.bag",
        "t265_only_v2.53.1.bag", "uncompressed_2depth_v2.53.1.bag"}) {
    SCOPED_TRACE(file);
    EXPECT_EQ(check_sim_poses(file, -20.0), 72U);
  }
  EXPECT_EQ(check_sim_poses("t265imu_v2.53.1.bag", 0.0), 20U);
}

TEST_F(Bags, carry_the_tracker_s_confidence) {
  auto poses = open_bag_poses(bag("d435_t265_v2.53.1.bag"), {}).value();
  for (const int expected : {1, 1, 2, 2, 3, 3}) {
    const auto pose = poses.stream->next();
    ASSERT_TRUE(pose && *pose);
    EXPECT_EQ((*pose)->confidence, expected);
  }
  const auto reading = test::read_all("bag:" + bag("d435_t265_v2.53.1.bag"));
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), 10U);
  EXPECT_EQ(reading.tally.poses_refused, 2U) << "two of low confidence";
}

/// Distance [m] of the worst back-projected pixel from the wall or the floor of the wall scene, and
/// the number of pixels.
std::pair<double, std::size_t> worst_off_the_wall(const std::string& options) {
  const auto reading = test::read_all("bag:" + bag("wall_v2.53.1.bag") + options);
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), 8U);
  double worst_m = 0.0;
  std::size_t pixels = 0;
  for (const Frame& frame : reading.frames) {
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 424; ++u) {
        const float z_m = frame.depth.depth_m(u, v);
        if (z_m == 0.0F) continue;
        const Eigen::Vector3d p = frame.T_world_camera * frame.intrinsics.back_project(u, v, z_m);
        // The wall, z = -2 m in the T265's world, is x = 2 m in ours; the floor, y = -1 m, is z.
        worst_m = std::max(worst_m, std::min(std::abs(p.x() - 2.0), std::abs(p.z() + 1.0)));
        ++pixels;
      }
    }
  }
  return {worst_m, pixels};
}

TEST_F(Bags, put_every_pixel_on_the_wall_or_the_floor_within_the_rounding_of_depth) {
  const auto [worst_m, pixels] = worst_off_the_wall("");
  RecordProperty("worst_mm", std::to_string(worst_m * 1e3));
  EXPECT_GT(pixels, 8U * 400U * 230U);
  EXPECT_LT(worst_m, 0.00054);
}

TEST_F(Bags, are_visibly_off_the_wall_with_the_nearest_pose) {
  const auto [worst_m, pixels] = worst_off_the_wall("?pairing=nearest");
  RecordProperty("worst_mm", std::to_string(worst_m * 1e3));
  EXPECT_GT(worst_m, 0.0015);  // its README measured up to 2.07 mm
  EXPECT_LT(worst_m, 0.0025);
}

TEST_F(Bags, of_two_clocks_are_refused_with_the_reason) {
  const auto reading = test::read_all("bag:" + bag("mismatch_v2.53.1.bag"));
  EXPECT_TRUE(reading.frames.empty());
  EXPECT_THAT(reading.error,
              AllOf(HasSubstr("mismatch_v2.53.1.bag"), HasSubstr("the device's own clock"),
                    HasSubstr("global time"), HasSubstr("Global Time Enabled")));
  FrameTally tally = reading.tally;
  EXPECT_EQ(tally.of(FrameLoss::kClockMismatch), 2U);
}

TEST_F(Bags, of_system_time_do_not_join_poses_of_global_time) {
  const auto reading =
      test::read_all("bag:" + bag("d435_depth_sdk2.13.bag") + "," + bag("t265_only_v2.53.1.bag"));
  EXPECT_TRUE(reading.frames.empty());
  EXPECT_THAT(reading.error, HasSubstr("system time"));
}

TEST_F(Bags, of_two_devices_join_into_the_same_map_as_the_one_of_both) {
  const auto both = test::map_bits("bag:" + bag("d435_t265_v2.53.1.bag"));
  const auto joined =
      test::map_bits("bag:" + bag("d435_only_v2.53.1.bag") + "," + bag("t265_only_v2.53.1.bag"));
  EXPECT_EQ(both.frames, 10U);
  EXPECT_GT(both.known_voxels, 500U);
  EXPECT_EQ(both, joined);
  EXPECT_EQ(both, test::map_bits("bag:" + bag("pipeline_recorded_v2.53.1.bag")));
  EXPECT_EQ(both, test::map_bits("bag:" + bag("d435_t265_v2.57.2.bag")));
  EXPECT_NE(both, test::map_bits("bag:" + bag("d435_only_v2.53.1.bag") + "," +
                                 bag("t265_only_v2.53.1.bag") + "?pose_offset_ms=30"));
}

TEST_F(Bags, of_a_real_d435_hold_the_depth_of_the_images_beside_them) {
  auto depth = open_bag_depth(bag("librealsense_single_depth_color_640x480.bag"), {});
  ASSERT_TRUE(depth) << depth.error().text();
  EXPECT_NEAR(depth->intrinsics.fx(), 390.43, 0.01);
  EXPECT_NEAR(depth->intrinsics.cy(), 242.19, 0.01);
  EXPECT_NEAR(depth->baseline_m.value(), 0.05017, 1e-5);
  for (const int k : {0, 1}) {
    const auto frame = depth->stream->next();
    ASSERT_TRUE(frame && *frame);
    const auto png = read_depth_png(bag(fmt::format("librealsense_depth_{}.png", k)), {});
    ASSERT_TRUE(png) << png.error().text();
    EXPECT_TRUE(std::ranges::equal((*frame)->depth.raw.pixels(), png->raw.pixels())) << k;
    EXPECT_EQ((*frame)->depth.unit_m, 0.001F);
    EXPECT_EQ((*frame)->clock, ClockDomain::kDevice);
    // Frame Timestamp 360815089 us, Sensor Timestamp 360811863 us: mid-exposure is 3.226 ms before.
    EXPECT_EQ((*frame)->stamp.ns, k == 0 ? 360'811'863'000 : 360'978'539'000);
  }
  const auto end = depth->stream->next();
  EXPECT_TRUE(end && !*end);
  EXPECT_THAT(test::read_all("bag:" + bag("librealsense_single_depth_color_640x480.bag")).error,
              AllOf(HasSubstr("no poses"), HasSubstr("bag:depth.bag,pose.bag")));
}

TEST_F(Bags, of_a_real_t265_through_ros_hold_its_odometry) {
  auto poses = open_bag_poses(bag("kapture_t265_trimmed_locoffice.bag"), {});
  ASSERT_TRUE(poses) << poses.error().text();
  EXPECT_EQ(poses->topic, "/camera/odom/sample");
  EXPECT_EQ(poses->child_frame, "camera_pose_frame");
  std::vector<PoseSample> samples;
  while (true) {
    const auto pose = poses->stream->next();
    ASSERT_TRUE(pose) << pose.error().text();
    if (!*pose) break;
    samples.push_back(**pose);
  }
  ASSERT_EQ(samples.size(), 19U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].R_world_body.norm(), 1.0, 1e-5);
    if (i == 0) continue;
    // 200 Hz, and a person who walks.
    EXPECT_NEAR(seconds(samples[i].stamp - samples[i - 1].stamp), 0.005, 0.0005);
    EXPECT_LT((samples[i].t_world_body_m - samples[i - 1].t_world_body_m).norm(), 0.01);
  }
  EXPECT_THAT(test::read_all("bag:" + bag("kapture_t265_trimmed_locoffice.bag")).error,
              AllOf(HasSubstr("no depth images"), HasSubstr("/camera/fisheye1/image_raw")));
}

TEST_F(Bags, can_be_cut_off_anywhere_and_give_what_came_before) {
  const std::string whole = test::content_of(bag("wall_v2.53.1.bag"));
  test::TempFolder folder;
  const auto cut = folder / "cut.bag";
  std::size_t most = 0;
  for (std::size_t bytes = 0; bytes < whole.size();
       bytes = std::min(bytes + 4999, std::max(whole.size() - 1, bytes + 1))) {
    test::write_file(cut, std::string_view(whole).substr(0, bytes));
    auto depth = open_bag_depth(cut, {});
    if (!depth) continue;
    std::size_t frames = 0;
    while (true) {
      const auto frame = depth->stream->next();
      if (!frame) {
        EXPECT_THAT(frame.error().text(), HasSubstr("byte "));
      }
      if (!frame || !*frame) break;
      ++frames;
    }
    EXPECT_GE(frames, most) << "cut at " << bytes;
    most = frames;
  }
  EXPECT_EQ(most, 8U) << "the last cut is in the index, which is not needed";
}

}  // namespace
}  // namespace swiftlet
