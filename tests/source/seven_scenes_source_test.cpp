// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/recordings.hpp"

namespace swiftlet {
namespace {

using test::flat;
using test::read_all;
using test::write_file;
using test::write_png;
using ::testing::AllOf;
using ::testing::HasSubstr;

class SevenScenes : public ::testing::Test {
 protected:
  void SetUp() override { test::write_seven_scenes(folder_.path()); }
  [[nodiscard]] std::string address() const { return "7scenes:" + folder_.path().string(); }
  [[nodiscard]] static std::string bad_pose() { return "inf 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"; }
  test::TempFolder folder_;
};

TEST_F(SevenScenes, delivers_every_frame_with_its_camera) {
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 3U);
  EXPECT_EQ(reading.frames[0].intrinsics, PinholeIntrinsics::create(24, 16, 20, 20, 11.5, 7.5));
  EXPECT_FLOAT_EQ(reading.frames[0].depth.depth_m(3, 3), 2.0F);
}

TEST_F(SevenScenes, says_what_it_knows_before_the_first_frame) {
  const auto source = open_source(address());
  ASSERT_TRUE(source);
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.frame_count, 3U);
  EXPECT_EQ(info.native_up_axis, "-y");
  EXPECT_EQ(info.baseline_m, 0.075);
}

TEST_F(SevenScenes, orders_by_number_and_stamps_numbers_at_30_hz) {
  test::write_seven_scenes_frame(folder_.path(), 1000000);
  test::write_seven_scenes_frame(folder_.path(), 30);
  const auto reading = read_all(address());
  std::vector<std::int64_t> stamps_ns;
  for (const Frame& frame : reading.frames) stamps_ns.push_back(frame.stamp.ns);
  EXPECT_THAT(stamps_ns, ::testing::ElementsAre(0, 33333333, 66666666, 1000000000, 33333333333333));
}

TEST_F(SevenScenes, turns_the_optical_world_z_up) {
  // A camera 1 m ahead, 2 m to the right and 3 m below the first one, turned 90 degrees right.
  test::write_seven_scenes_frame(folder_.path(), 3, flat(1000),
                                 "0 0 1 2\n0 1 0 3\n-1 0 0 1\n0 0 0 1\n");
  const auto reading = read_all(address());
  ASSERT_EQ(reading.frames.size(), 4U);
  const auto& first = reading.frames[0].T_world_camera;
  EXPECT_TRUE((first * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0)))
      << "forward is x";
  EXPECT_TRUE((first * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, -1, 0)))
      << "right is -y";
  EXPECT_TRUE((first * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, -1)))
      << "down is -z";
  const auto& turned = reading.frames[3].T_world_camera;
  EXPECT_TRUE(turned.translation().isApprox(Eigen::Vector3d(1, -2, -3)));
  EXPECT_TRUE((turned.rotation() * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(0, -1, 0)));
}

TEST_F(SevenScenes, delivers_frames_without_a_single_reading) {
  write_png(folder_ / "frame-000000.depth.png", flat(0));
  write_png(folder_ / "frame-000001.depth.png", flat(65535));
  const auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  ASSERT_EQ(reading.frames.size(), 3U);
  const auto readings_in = [&](std::size_t i) {
    const auto pixels = reading.frames[i].depth.raw.pixels();
    return static_cast<long>(pixels.size()) - std::ranges::count(pixels, 0);
  };
  EXPECT_EQ(readings_in(0), 0);
  EXPECT_EQ(readings_in(1), 0);
  EXPECT_EQ(readings_in(2), 24 * 16);
}

TEST_F(SevenScenes, of_the_data_set_itself_needs_no_intrinsics) {
  const auto sequence = folder_ / "seq-07";
  std::filesystem::create_directory(sequence);
  for (const int number : {0, 1})
    test::write_seven_scenes_frame(sequence, number, Image<std::uint16_t>(640, 480, 1000));
  const std::string address = "7scenes:" + sequence.string();
  EXPECT_THAT(read_all(address).error, HasSubstr("nobody tells the intrinsics"))
      << "others have numbered folders, too";
  write_png(sequence / "frame-000000.color.png", flat(1), test::PngKind::kRgb8);
  const auto reading = read_all(address);
  ASSERT_EQ(reading.frames.size(), 2U) << reading.error;
  EXPECT_EQ(reading.frames[0].intrinsics, PinholeIntrinsics::create(640, 480, 585, 585, 320, 240));
  EXPECT_EQ((*open_source(address))->info().intrinsics.origin, IntrinsicsOrigin::kKnownDataset);
}

TEST_F(SevenScenes, of_anybody_else_demands_intrinsics_and_says_how_to_give_them) {
  std::filesystem::remove(folder_ / "camera-intrinsics.txt");
  EXPECT_THAT(read_all(address()).error,
              AllOf(HasSubstr("24 x 16"), HasSubstr("camera-intrinsics.txt")));
  for (const int number : {0, 1, 2})
    test::write_seven_scenes_frame(folder_.path(), number, Image<std::uint16_t>(640, 480, 1000));
  EXPECT_THAT(read_all(address()).error,
              AllOf(HasSubstr("640 x 480"), HasSubstr("?intrinsics=fx,fy,cx,cy")));
  const auto reading = read_all(address() + "?intrinsics=585,585,320,240");
  ASSERT_EQ(reading.frames.size(), 3U) << reading.error;
  EXPECT_EQ(reading.frames[0].intrinsics, PinholeIntrinsics::create(640, 480, 585, 585, 320, 240));
}

TEST_F(SevenScenes, takes_the_depth_unit_and_the_up_axis_from_its_address_but_no_time) {
  const auto reading = read_all(address() + "?depth_unit_m=0.0002&up=+z");
  ASSERT_EQ(reading.frames.size(), 3U) << reading.error;
  EXPECT_FLOAT_EQ(reading.frames[0].depth.depth_m(3, 3), 0.4F);
  EXPECT_TRUE(reading.frames[0].T_world_camera.rotation().isApprox(Eigen::Quaterniond::Identity()));
  EXPECT_THAT(read_all(address() + "?time_offset_ms=3").error, HasSubstr("cannot be meant"));
}

TEST_F(SevenScenes, given_a_whole_scene_asks_for_one_of_its_sequences) {
  test::TempFolder scene;
  std::filesystem::create_directory(scene / "seq-01");
  EXPECT_THAT(read_all("7scenes:" + scene.path().string()).error, HasSubstr("seq-01"));
}

TEST_F(SevenScenes, ignores_colour_images_and_other_files) {
  write_png(folder_ / "frame-000000.color.png", flat(1), test::PngKind::kRgb8);
  write_file(folder_ / "frame-abc.depth.png", "no number");
  write_file(folder_ / "frame-.depth.png", "no number");
  EXPECT_EQ(read_all(address()).frames.size(), 3U);
}

TEST_F(SevenScenes, refuses_two_files_of_one_number) {
  write_png(folder_ / "frame-1.depth.png", flat(1));
  write_file(folder_ / "frame-1.pose.txt", test::kIdentityPose);
  EXPECT_THAT(read_all(address()).error, HasSubstr("same frame number"));
}

TEST_F(SevenScenes, leaves_out_and_counts_a_depth_image_without_a_pose) {
  std::filesystem::remove(folder_ / "frame-000001.pose.txt");
  auto reading = read_all(address());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), 2U);
  EXPECT_EQ(reading.tally.of(FrameLoss::kNoPose), 1U);
  ASSERT_EQ(reading.events.size(), 1U);
  EXPECT_THAT(reading.events[0].who, HasSubstr("frame-000001.pose.txt"));
}

struct BadPose {
  const char* text;
  const char* complaint;
};

TEST_F(SevenScenes, leaves_out_and_counts_a_bad_pose_naming_file_and_fault) {
  const BadPose bad[] = {
      {"nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "not finite"},
      {"1 0 0 nan\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "not finite"},
      {"1 0 0 -inf\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "not finite"},
      {"-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n",
       "not finite"},
      {"1 0 0.2 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "not orthonormal"},
      {"2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n", "not orthonormal"},
      {"1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n", "not orthonormal"},
      {"1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 2\n", "last row"},
      {"1 0 0 0\n0 1 0 0\n0 0 1 0\n", "4 x 4 numbers, but has 12"},
      {"1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1\n", "but has 17"},
      {"1 0 0 0\n0 1 zero 0\n0 0 1 0\n0 0 0 1\n", "'zero' (row 2, column 3)"},
      {"", "but has 0"},
  };
  for (const BadPose& pose : bad) {
    write_file(folder_ / "frame-000001.pose.txt", pose.text);
    auto reading = read_all(address());
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.frames.size(), 2U) << "the others stay good";
    EXPECT_EQ(reading.tally.of(FrameLoss::kPoseRefused), 1U);
    ASSERT_EQ(reading.events.size(), 1U);
    EXPECT_THAT(reading.events[0].who, HasSubstr("frame-000001.pose.txt"));
    EXPECT_THAT(reading.events[0].what, HasSubstr(pose.complaint));
  }
}

TEST_F(SevenScenes, without_a_single_good_pose_is_an_error_that_names_the_first) {
  for (const int number : {0, 1, 2})
    write_file(folder_ / fmt::format("frame-{:06}.pose.txt", number), bad_pose());
  EXPECT_THAT(read_all(address()).error,
              AllOf(HasSubstr("frame-000000.pose.txt"), HasSubstr("not finite"),
                    HasSubstr("camera-to-world")));
}

TEST_F(SevenScenes, tells_of_the_first_bad_records_and_counts_all) {
  for (int number = 3; number < 40; ++number)
    test::write_seven_scenes_frame(folder_.path(), number, flat(2000), bad_pose());
  auto reading = read_all(address());
  EXPECT_EQ(reading.frames.size(), 3U) << reading.error;
  EXPECT_EQ(reading.tally.of(FrameLoss::kPoseRefused), 37U);
  EXPECT_EQ(reading.events.size(), 5U);
}

TEST_F(SevenScenes, reads_poses_as_microsoft_writes_them) {
  write_file(folder_ / "frame-000001.pose.txt",
             "  9.9935108e-001\t -1.5576084e-002\t  3.1508941e-002\t -1.2323361e-001\t\r\n"
             "  9.1375999e-003\t  9.8130137e-001\t  1.9233750e-001\t -1.1206967e+000\t\r\n"
             " -3.3915614e-002\t -1.9192319e-001\t  9.8080140e-001\t -9.8870575e-001\t\r\n"
             "  0.0000000e+000\t  0.0000000e+000\t  0.0000000e+000\t  1.0000000e+000\t\r\n");
  const auto reading = read_all(address());
  ASSERT_EQ(reading.frames.size(), 3U) << reading.error;
  EXPECT_TRUE(reading.frames[1].T_world_camera.translation().isApprox(
      Eigen::Vector3d(-0.98870575, 0.12323361, 1.1206967)));
}

TEST_F(SevenScenes, refuses_a_camera_that_cannot_be_used) {
  const BadPose bad[] = {
      {"0 0 11.5\n0 20 7.5\n0 0 1\n", "singular"},
      {"0 0 0\n0 0 0\n0 0 0\n", "singular"},
      {"20 0 nan\n0 20 7.5\n0 0 1\n", "not finite"},
      {"20 0.5 11.5\n0 20 7.5\n0 0 1\n", "skew"},
      {"20 0 11.5\n0 20 7.5\n0 0 2\n", "skew"},
      {"20 20 11.5 7.5\n", "3 x 3 numbers, but has 4"},
  };
  for (const BadPose& camera : bad) {
    write_file(folder_ / "camera-intrinsics.txt", camera.text);
    const auto reading = read_all(address());
    EXPECT_TRUE(reading.frames.empty());
    EXPECT_THAT(reading.error,
                AllOf(HasSubstr("camera-intrinsics.txt"), HasSubstr(camera.complaint)));
  }
}

TEST_F(SevenScenes, leaves_out_and_counts_a_damaged_image_naming_it) {
  const std::string whole = test::content_of(folder_ / "frame-000001.depth.png");
  for (std::size_t part = 0; part < 16; ++part) {
    write_file(folder_ / "frame-000001.depth.png",
               std::string_view(whole).substr(0, whole.size() * part / 16));
    auto reading = read_all(address());
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.frames.size(), 2U);
    EXPECT_EQ(reading.tally.of(FrameLoss::kImageUnreadable), 1U);
    ASSERT_EQ(reading.events.size(), 1U);
    EXPECT_THAT(reading.events[0].who, HasSubstr("frame-000001.depth.png"));
    EXPECT_THAT(reading.events[0].what, HasSubstr("damaged"));
  }
}

TEST_F(SevenScenes, leaves_out_and_counts_an_image_of_another_kind_or_size) {
  const auto complaint = [&] {
    auto reading = read_all(address());
    EXPECT_EQ(reading.frames.size(), 2U) << reading.error;
    EXPECT_EQ(reading.tally.of(FrameLoss::kImageUnreadable), 1U);
    return reading.events.empty() ? "" : reading.events[0].what;
  };
  for (const auto kind : {test::PngKind::kGrey8, test::PngKind::kRgb8}) {
    write_png(folder_ / "frame-000001.depth.png", flat(2000), kind);
    EXPECT_THAT(complaint(), HasSubstr("not a depth image"));
  }
  write_png(folder_ / "frame-000001.depth.png", Image<std::uint16_t>(16, 24, 1));
  EXPECT_THAT(complaint(), HasSubstr("16 x 24 pixels, but the first image has 24 x 16"));
}

}  // namespace
}  // namespace swiftlet
