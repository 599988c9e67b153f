// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What a TUM folder takes from its address, and how its camera is recognised.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source/tum_folder.hpp"

namespace swiftlet {
namespace {

using test::expect_true_poses;
using test::read_all;
using test::true_pose;
using test::Tum;
using test::write_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(Tum, takes_the_depth_unit_the_up_axis_and_a_time_offset_from_its_address) {
  const auto unit = read_all(address() + "?depth_unit_m=0.001");
  ASSERT_EQ(unit.frames.size(), 13U) << unit.error;
  EXPECT_FLOAT_EQ(unit.frames[0].depth.depth_m(0, 0), 10.0F);

  const auto up = read_all(address() + "?up=-y&depth_unit_m=0.0002");
  ASSERT_EQ(up.frames.size(), 13U) << up.error;
  const Eigen::Vector3d native = true_pose(0.1).translation();
  EXPECT_LT((up.frames[0].T_world_camera.translation() -
             Eigen::Vector3d(native.z(), -native.x(), -native.y()))
                .norm(),
            1e-9);

  // Images stamped 100 ms early by their camera: with the offset the first three have a pose, too.
  const auto offset = read_all(address() + "?time_offset_ms=100");
  ASSERT_EQ(offset.frames.size(), 16U) << offset.error;
  expect_true_poses(offset.frames);
}

TEST_F(Tum, refuses_an_option_that_cannot_be_meant_naming_those_there_are) {
  for (const char* option : {"depth_unit_m=0", "depth_unit_m=nan", "up=w", "up=+",
                             "intrinsics=", "time_offset_ms=soon", "rig=x.yaml"}) {
    EXPECT_THAT(read_all(address() + "?" + option).error,
                AllOf(HasSubstr(option), HasSubstr("cannot be meant"), HasSubstr("depth_unit_m")));
  }
}

TEST_F(Tum, may_lie_in_a_folder_with_a_question_mark_in_its_name) {
  const auto odd = folder_ / "what?up=+z";
  std::filesystem::create_directory(odd);
  for (const char* name : {"depth", "depth.txt", "groundtruth.txt", "camera-intrinsics.txt"})
    std::filesystem::rename(folder_ / name, odd / name);
  EXPECT_EQ(read_all("tum:" + odd.string()).frames.size(), 13U);
  const auto reading = read_all("tum:" + odd.string() + "?depth_unit_m=0.001");
  ASSERT_EQ(reading.frames.size(), 13U) << reading.error;
  EXPECT_FLOAT_EQ(reading.frames[0].depth.depth_m(0, 0), 10.0F);
}

TEST_F(Tum, says_whether_somebody_told_the_depth_unit) {
  EXPECT_TRUE((*open_source(address()))->info().assumed_depth_unit_m);
  EXPECT_FALSE((*open_source(address() + "?depth_unit_m=0.0002"))->info().assumed_depth_unit_m);
}

TEST_F(Tum, takes_intrinsics_by_option_before_those_of_the_folder_and_says_so) {
  const auto origin = [](const std::string& from) {
    const auto source = open_source(from);
    return source ? text_of((*source)->info().intrinsics) : source.error().text();
  };
  EXPECT_EQ(origin(address()), "file: " + (folder_ / "camera-intrinsics.txt").string());
  EXPECT_EQ(origin(address() + "?intrinsics=30,31,12,8"), "option: 30,31,12,8");
  const auto reading = read_all(address() + "?intrinsics=30,31,12,8");
  ASSERT_FALSE(reading.frames.empty()) << reading.error;
  EXPECT_EQ(reading.frames[0].intrinsics, PinholeIntrinsics::create(24, 16, 30, 31, 12, 8));

  const auto file = (folder_ / "my_camera.txt").string();
  write_file(file, "40 0 11\n0 41 7\n0 0 1\n");
  EXPECT_EQ(origin(address() + "?intrinsics=" + file), "file: " + file);
  EXPECT_EQ(read_all(address() + "?intrinsics=" + file).frames[0].intrinsics.fy(), 41.0);
  EXPECT_THAT(origin(address() + "?intrinsics=0,0,12,8"), HasSubstr("singular"));
  EXPECT_THAT(origin(address() + "?intrinsics=30,31,12"), HasSubstr("no such file"));
}

TEST_F(Tum, takes_full_scale_for_no_reading) {
  for (const std::uint16_t value : {std::uint16_t{0}, std::uint16_t{65535}}) {
    test::write_png(folder_ / "depth/1305031102.100000.png", test::flat(value));
    const auto reading = read_all(address());
    ASSERT_EQ(reading.frames.size(), 13U);
    for (const auto pixel : reading.frames[0].depth.raw.pixels()) EXPECT_EQ(pixel, 0);
  }
}

/// A folder of one image of 640 x 480 pixels, without a camera-intrinsics.txt.
class TumDataset : public ::testing::Test {
 protected:
  [[nodiscard]] std::string folder_named(const std::string& name, const std::string& head = "") {
    const auto folder = parent_ / name;
    std::filesystem::create_directory(folder);
    test::write_png(folder / "0.png", Image<std::uint16_t>(640, 480, 5000));
    write_file(folder / "depth.txt", head + "1.0 0.png\n");
    write_file(folder / "groundtruth.txt", "0.95 0 0 0 0 0 0 1\n1.05 0 0 0 0 0 0 1\n");
    return "tum:" + folder.string();
  }
  test::TempFolder parent_;
};

TEST_F(TumDataset, is_known_by_the_name_of_its_folder) {
  const std::pair<const char*, double> cameras[] = {{"rgbd_dataset_freiburg1_xyz", 517.3},
                                                    {"rgbd_dataset_freiburg2_desk", 520.9},
                                                    {"fr3_office", 535.4}};
  for (const auto& [name, fx_px] : cameras) {
    const std::string plain = folder_named(name);
    for (const auto& address : {plain, plain + "/"}) {
      const auto reading = read_all(address);
      ASSERT_EQ(reading.frames.size(), 1U) << reading.error;
      EXPECT_EQ(reading.frames[0].intrinsics.fx(), fx_px) << address;
    }
  }
}

TEST_F(TumDataset, is_known_by_the_head_of_its_list_whatever_the_folder_is_called) {
  const auto address = folder_named(
      "copy_of_fr1", "# depth maps\n# file: 'rgbd_dataset_freiburg3_cabinet.bag'\n# timestamp\n");
  const auto source = open_source(address);
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_EQ(text_of((*source)->info().intrinsics),
            "known dataset: TUM freiburg3, by the head of depth.txt");
}

TEST_F(TumDataset, that_it_is_not_has_no_intrinsics_and_the_error_says_how_to_give_them) {
  for (const char* name : {"my_flight", "freiburg", "freiburg4_desk", "afr1", "fr12"}) {
    EXPECT_THAT(read_all(folder_named(name)).error,
                AllOf(HasSubstr("nobody tells the intrinsics"), HasSubstr("camera-intrinsics.txt"),
                      HasSubstr("?intrinsics=fx,fy,cx,cy")))
        << name;
  }
}

TEST_F(TumDataset, of_another_image_size_is_not_given_its_intrinsics) {
  const auto address = folder_named("freiburg1_xyz");
  test::write_png(parent_ / "freiburg1_xyz/0.png", Image<std::uint16_t>(320, 240, 5000));
  EXPECT_THAT(read_all(address).error, AllOf(HasSubstr("320 x 240"), HasSubstr("640 x 480 only")));
}

}  // namespace
}  // namespace swiftlet
