// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recordings.hpp"

namespace swiftlet {
namespace {

using test::read_all;
using test::write_file;
using ::testing::HasSubstr;

// As the data set has them: OpenCV's own kind of YAML, intrinsics as fx, cx, fy, cy, the depth
// camera tied to the colour camera.
constexpr std::string_view kSensors = R"(%YAML:1.0
---
d400_color_optical_frame:
   width: 24
   height: 16
   fps: 30.
   model: pinhole
   intrinsics: !!opencv-matrix
      rows: 1
      cols: 4
      dt: d
      data: [ 30., 11.0, 30., 7.0 ]
d400_depth_optical_frame:
   width: 24
   height: 16
   fps: 30.
   model: pinhole
   intrinsics: !!opencv-matrix
      rows: 1
      cols: 4
      dt: d
      data: [ 20., 11.5, 21., 7.5 ]
   distortion_model: radial-tangential
   distortion_coefficients: !!opencv-matrix
      rows: 1
      cols: 5
      dt: d
      data: [ 0., 0., 0., 0., 0. ]
)";
// base_link -> colour: looks forward, 0.2 m ahead, 0.9 m up; colour -> depth: 15 mm to the left.
constexpr std::string_view kTransforms = R"(%YAML:1.0
---
trans_matrix:
   -
      parent_frame: base_link
      child_frame: d400_color_optical_frame
      matrix: !!opencv-matrix
         rows: 4
         cols: 4
         dt: d
         data: [ 0., 0., 1., 0.2, -1., 0., 0., 0., 0., -1., 0., 0.9, 0., 0., 0., 1. ]
   -
      parent_frame: d400_color_optical_frame
      child_frame: d400_depth_optical_frame
      matrix: !!opencv-matrix
         rows: 4
         cols: 4
         dt: d
         data: [ 1., 0., 0., -0.015, 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1. ]
)";

class OpenLoris : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "depth");
    write_file(folder_ / "sensors.yaml", kSensors);
    write_file(folder_ / "trans_matrix.yaml", kTransforms);
    std::string images = "#Time File\n", poses = "#Time px py pz qx qy qz qw\n";
    for (int i = 0; i < 5; ++i) {
      const auto stamp = fmt::format("1560004885.{:06}", 100'000 + 33'333 * i);
      test::write_png(folder_ / ("depth/" + stamp + ".png"), test::flat(1500));
      images += stamp + " depth/" + stamp + ".png\n";
    }
    // 1 m/s along x, turned left by 90 degrees: the robot drives to its right.
    for (int i = 0; i <= 30; ++i)
      poses +=
          fmt::format("1560004885.{:06} {} 2 0 0 0 0.70710678 0.70710678\n", 10'000 * i, 0.01 * i);
    write_file(folder_ / "depth.txt", images);
    write_file(folder_ / "aligned_depth.txt", images);
    write_file(folder_ / "groundtruth.txt", poses);
  }
  [[nodiscard]] std::string address() const { return "openloris:" + folder_.path().string(); }

  test::TempFolder folder_;
};

TEST_F(OpenLoris, poses_its_depth_camera_by_the_base_link_and_the_chain_of_mounts) {
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 5U);
  const Frame& frame = reading.frames[1];
  // The robot is at (0.133, 2, 0) and heads along y; the camera looks along y, too, 0.2 m ahead and
  // 15 mm to the left, which is -x.
  const Eigen::Vector3d place(0.133333 - 0.015, 2.2, 0.9);
  EXPECT_LT((frame.T_world_camera.translation() - place).norm(), 1e-6);
  const Eigen::Vector3d looks = frame.T_world_camera.rotation() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((looks - Eigen::Vector3d::UnitY()).norm(), 1e-6);
  EXPECT_EQ(frame.intrinsics, PinholeIntrinsics::create(24, 16, 20, 21, 11.5, 7.5).value());
  EXPECT_EQ(frame.depth.raw.at(3, 3), 1500);
}

TEST_F(OpenLoris, uses_the_colour_camera_for_aligned_depth) {
  const auto reading = read_all(address() + "?images=aligned_depth");
  ASSERT_EQ(reading.frames.size(), 5U) << reading.error;
  EXPECT_EQ(reading.frames[0].intrinsics.fx(), 30.0);
  EXPECT_NEAR(reading.frames[0].T_world_camera.translation().x(), 0.1, 1e-6);
}

TEST_F(OpenLoris, takes_the_poses_of_your_own_odometry_behind_the_gates) {
  std::string poses = test::content_of(folder_ / "groundtruth.txt");
  const std::size_t line = poses.find("1560004885.150000 0.15 ");
  ASSERT_NE(line, std::string::npos);
  poses.replace(line, 22, "1560004885.150000 9.15");
  write_file(folder_ / "vio.txt", poses);
  const auto reading = read_all(address() + "?poses=" + (folder_ / "vio.txt").string());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), 5U);
  EXPECT_EQ(reading.tally.poses_refused, 1U) << "9 m in 10 ms and back";
}

TEST_F(OpenLoris, says_what_is_wrong_with_its_files) {
  const auto with = [&](const char* file, std::string text, const char* what, const char* by) {
    const std::string good = text;
    text.replace(text.find(what), std::string_view(what).size(), by);
    write_file(folder_ / file, text);
    const std::string error = read_all(address()).error;
    write_file(folder_ / file, good);
    return error;
  };
  const std::string sensors(kSensors), transforms(kTransforms);
  EXPECT_THAT(with("sensors.yaml", sensors, "[ 20., 11.5, 21.", "[ 20., 21., 11.5"),
              HasSubstr("fx, cx, fy, cy"));
  EXPECT_THAT(with("sensors.yaml", sensors, "data: [ 0., 0.", "data: [ 0.1, 0."),
              HasSubstr("distortion"));
  EXPECT_THAT(with("sensors.yaml", sensors, "d400_depth", "d500_depth"),
              HasSubstr("does not know the camera"));
  EXPECT_THAT(with("sensors.yaml", sensors,
                   "   height: 16\n   fps: 30.\n   model: pinhole\n   "
                   "intrinsics: !!opencv-matrix\n      rows: 1\n      "
                   "cols: 4\n      dt: d\n      data: [ 20.",
                   "   data: [ 20."),
              HasSubstr("sensors.yaml"));
  EXPECT_THAT(
      with("trans_matrix.yaml", transforms, "parent_frame: base_link", "parent_frame: nothing"),
      HasSubstr("no chain leads from base_link"));
  EXPECT_THAT(with("trans_matrix.yaml", transforms, "data: [ 0., 0., 1.,", "data: [ 0., 0., 3.,"),
              HasSubstr("trans_matrix.yaml"));
  EXPECT_THAT(read_all(address() + "?images=colour").error, HasSubstr("cannot be meant"));
  std::filesystem::remove(folder_ / "groundtruth.txt");
  EXPECT_THAT(read_all(address()).error, HasSubstr("groundtruth.txt"));
}

TEST_F(OpenLoris, leaves_out_and_counts_bad_images_and_poses) {
  write_file(folder_ / "depth/1560004885.133333.png", "no image");
  std::filesystem::remove(folder_ / "depth/1560004885.166666.png");
  write_file(folder_ / "groundtruth.txt",
             "1560004885.105 nan 0 0 0 0 0 1\n" + test::content_of(folder_ / "groundtruth.txt"));
  auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), 3U);
  EXPECT_EQ(reading.tally.of(FrameLoss::kImageUnreadable), 1U);
  EXPECT_EQ(reading.tally.of(FrameLoss::kImageMissing), 1U);
  EXPECT_EQ(reading.tally.poses_refused, 1U);
  EXPECT_EQ(reading.events.size(), 2U);
}

TEST_F(OpenLoris, without_a_single_good_image_is_an_error) {
  for (const auto& image : std::filesystem::directory_iterator(folder_ / "depth"))
    write_file(image.path(), "no image");
  EXPECT_THAT(read_all(address()).error, HasSubstr("damaged PNG"));
}

TEST_F(OpenLoris, takes_depth_unit_and_time_offset_and_says_who_told_its_intrinsics) {
  const auto reading = read_all(address() + "?depth_unit_m=0.0001&time_offset_ms=-50");
  ASSERT_EQ(reading.frames.size(), 5U) << reading.error;
  EXPECT_FLOAT_EQ(reading.frames[0].depth.depth_m(0, 0), 0.15F);
  EXPECT_EQ(reading.frames[0].stamp.ns, 1560004885'050'000'000);
  const auto source = open_source(address());
  EXPECT_EQ(text_of((*source)->info().intrinsics), "file: " + (folder_ / "sensors.yaml").string());
}

}  // namespace
}  // namespace swiftlet
