// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"

namespace swiftlet::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

#if SWIFTLET_HAS_EMBREE
constexpr const char* kBent = "sim:calibration?barrel=0.1&frames=40";

TEST(Calibrate, brings_a_barrel_of_a_tenth_below_one_percent_all_over_the_image) {
  const TempFolder folder;
  const auto walls = run_for_json({"calibrate", "distortion", kBent, "--distance", "1.4", "--check",
                                   "sim:calibration?barrel=0.1&start=4.2&frames=40", "2.8", "-o",
                                   "distortion.yaml", "--report", "bent", "--json"},
                                  folder.path())
                         .at("walls");
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_GT(walls[0].at("error_raw"), 0.1);
  EXPECT_LT(walls[0].at("error_self_calibrated"), 0.01);
  EXPECT_GT(walls[1].at("error_raw"), 0.2) << "an error of disparity grows with distance";
  EXPECT_LT(walls[1].at("error_pre_calibrated"), 0.25 * double{walls[1].at("error_raw")});

  const std::string page = content_of(folder / "bent" / "report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("Depth distortion"), HasSubstr("prefers-color-scheme: dark"),
                          Not(HasSubstr("<script"))));
  EXPECT_THAT(
      content_of(folder / "bent" / "histogram_wall_2.80m.csv"),
      AllOf(HasSubstr("raw,"), HasSubstr("self-calibrated,"), HasSubstr("pre-calibrated,")));
  EXPECT_THAT(content_of(folder / "bent" / "top_view_wall_1.40m.csv"), HasSubstr("wall,"));
}

TEST(Calibrate, what_it_writes_is_a_config_with_which_the_wall_is_flat) {
  const TempFolder folder;
  ASSERT_EQ(run({"calibrate", "distortion", kBent, "--distance", "1.4", "-o", "distortion.yaml"},
                folder.path())
                .exit_code,
            0);
  // Voxels of 5 cm: the wall at x = 3 m, bent, would reach 19 cm farther.
  const auto bounds = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{
        "map", kBent, "-o", "wall.swl", "--overwrite", "--set", "map.voxel_m=0.05"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended mapped = run(arguments, folder.path());
    EXPECT_EQ(mapped.exit_code, 0) << mapped.err;
    const Ended told = run({"info", "wall.swl", "--json"}, folder.path());
    return nlohmann::json::parse(told.out);
  };
  const auto bent = bounds({}), straight = bounds({"--config", "distortion.yaml"});
  EXPECT_NE(bent, straight);
  EXPECT_LT(int{straight.at("voxels").at("occupied")}, int{bent.at("voxels").at("occupied")});
}

TEST(Calibrate, estimates_the_distance_if_it_is_not_told) {
  const TempFolder folder;
  const auto json = run_for_json({"calibrate", "distortion", kBent, "--json"}, folder.path());
  EXPECT_NEAR(double{json.at("walls")[0].at("distance_m")}, 1.4, 0.01);
  EXPECT_EQ(json.at("distortion").at("offset_m"), 0.0);
}
#endif

TEST(Calibrate, says_what_it_needs_where_there_is_no_wall) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "rec");
  write_file(folder / "rec" / "camera-intrinsics.txt", kSmallCamera);
  write_seven_scenes_frame(folder / "rec", 0, flat(0));
  const Ended empty = run({"calibrate", "distortion", "7scenes:rec"}, folder.path());
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_THAT(empty.err, HasSubstr("7scenes:rec: the wall does not fill the image; go nearer"));
  EXPECT_EQ(run({"calibrate", "colour", "7scenes:rec"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run({"calibrate", "distortion"}, folder.path()).exit_code, 2);
  const Ended nowhere = run({"calibrate", "distortion", "7scenes:nowhere"}, folder.path());
  EXPECT_EQ(nowhere.exit_code, 1);
}

}  // namespace
}  // namespace swiftlet::test
