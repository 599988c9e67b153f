// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the program tells of how right a map is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "swiftlet/app/report/score_report.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Score : public ::testing::Test {
 protected:
  Ended swiftlet(const std::vector<std::string>& arguments) const {
    return run(arguments, folder_.path());
  }
  Ended score_three_frames(const std::string& maps) const {
    std::filesystem::create_directory(folder_ / "rec");
    write_seven_scenes(folder_ / "rec");
    return swiftlet({"score", "7scenes:rec", "--maps", maps});
  }
  TempFolder folder_;
};

double value_of(const json& report, const std::string& name, const std::string& map) {
  for (const json& row : report.at("scores")) {
    if (row.at("name") == name) return row.at("values").at(map).get<double>();
  }
  ADD_FAILURE() << "no score " << name;
  return -1.0;
}

#if SWIFTLET_HAS_EMBREE

TEST_F(Score, a_short_flight_before_a_wall_is_judged_by_the_truth) {
  const Ended ended = swiftlet({"score", "sim:wall?noise=off&frames=10", "--maps",
                                "projective,rays,precision_weighted", "--set", "map.voxel_m=0.1",
                                "--set", "integrate.model=inverse_sensor_model", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json report = json::parse(ended.out);
  EXPECT_THAT(report.at("maps"), ElementsAre("projective", "rays", "precision_weighted"));
  for (const std::string map : {"projective", "rays", "precision_weighted"}) {
    EXPECT_EQ(value_of(report, "occupied recall, within 1 voxel", map), 1.0) << map;
    EXPECT_EQ(value_of(report, "occupied precision, within 1 voxel", map), 1.0) << map;
    EXPECT_EQ(value_of(report, "phantom voxels at the end", map), 0.0) << map;
    // The voxels before the wall may hold some of it: that model does not call them free.
    EXPECT_GT(value_of(report, "free recall", map), map == "precision_weighted" ? 0.78 : 0.8)
        << map;
    EXPECT_EQ(report.at("solid_voxels_called_free").at(map).size(),
              value_of(report, "solid voxels called free", map));
  }
}

TEST_F(Score, what_moves_is_judged_frame_by_frame) {
  const Ended ended = swiftlet({"score", "sim:walker?start=3&frames=60", "--maps", "projective",
                                "--set", "map.voxel_m=0.2", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json report = json::parse(ended.out);
  EXPECT_GE(value_of(report, "what comes is occupied after, median", "projective"), 1.0);
  EXPECT_GE(value_of(report, "what has gone is free after, median", "projective"), 1.0);
}

TEST_F(Score, a_truth_that_would_not_fit_is_refused_before_the_flight) {
  const Ended ended = swiftlet({"score", "sim:wall", "--maps", "projective", "--set",
                                "map.voxel_m=0.005", "--set", "map.size_m=[2,2,2]"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("million voxels; choose a larger map.voxel_m"));
}

#endif

TEST_F(Score, a_recording_is_judged_by_the_frames_that_were_left_out) {
  std::filesystem::create_directory(folder_ / "rec");
  write_file(folder_ / "rec" / "camera-intrinsics.txt", kSmallCamera);
  for (int i = 0; i < 10; ++i) write_seven_scenes_frame(folder_ / "rec", i);
  const Ended ended = swiftlet({"score", "7scenes:rec", "--maps", "rays", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json report = json::parse(ended.out);
  EXPECT_EQ(report.at("frames"), 10);
  EXPECT_EQ(report.at("scores").at(0).at("of"), 2 * 6 * 4) << "two frames, every fourth pixel";
  EXPECT_EQ(
      value_of(report, "left-out readings that end within 1 voxel of an occupied one", "rays"),
      1.0);
  EXPECT_EQ(value_of(report, "left-out rays blocked more than 2 voxels before", "rays"), 0.0);
}

TEST_F(Score, a_recording_of_four_frames_has_nothing_to_predict) {
  const Ended ended = score_three_frames("rays");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("give a recording of five frames or more"));
}

TEST_F(Score, a_map_that_does_not_exist_is_a_wrong_usage) {
  const Ended ended = score_three_frames("bonxai");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("unknown integrator 'bonxai'; known are: rays, projective"));
}

TEST(ScoreText, tells_each_score_in_its_unit_and_the_worst_voxels_first) {
  eval::ScoreReport report{"sim:a", 0.1, 10, 60.0, {"one", "two"}};
  using eval::Unit;
  eval::add_value(report, 0, "free", {"free precision", 0.5, Unit::kShare});
  eval::add_value(report, 1, "free", {"free precision", 0.25, Unit::kShare});
  eval::add_value(report, 1, "surface", {"surface offset, RMS", 0.0123, Unit::kMetres, false});
  report.findings = {{{{0, 0, 0}, "wall", true}, {{1, 0, 0}, "wire", false}}, {}};
  const std::string text = app::score_text(report);
  EXPECT_THAT(text, HasSubstr("50.000 %       25.000 %"));
  EXPECT_THAT(text, HasSubstr("-        12.3 mm"));
  EXPECT_LT(text.find("wire; no occupied neighbour"), text.find("wall"));
}

}  // namespace
}  // namespace swiftlet::test
