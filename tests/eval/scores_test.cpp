// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Scores of maps that are made by hand, of a corner of two walls with a rod in front: a perfect map
// gets full marks, and each defect moves the scores that are about it and no others.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>

#include "swiftlet/eval/score/score.hpp"
#include "swiftlet/eval/truth/leave_out.hpp"

namespace swiftlet::eval {
namespace {

using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Names = std::vector<std::string>;

constexpr double kVoxel_m = 0.1;
constexpr VoxelBox kScoredBox{{-4, -20, -4}, {26, 22, 20}};
const Eigen::Vector3f kEye(0.05F, 0.05F, 0.85F);

std::vector<sim::Object> corner() {
  return {{"front wall", sim::Box{{2.1, 0.1, 0.8}, {0.2, 3.4, 1.6}}},  // its face is at x = 2
          {"left wall", sim::Box{{1.0, 1.7, 0.8}, {2.0, 0.2, 1.6}}},   // its face is at y = 1.6
          {"rod", sim::Cylinder{{1.05, 0.05, 0.0}, {1.05, 0.05, 1.6}, 0.010}}};
}

/// Seen from kEye: all of both faces but what is behind the rod, and the rod.
Truth make_truth(const std::vector<sim::Object>& objects = corner()) {
  Truth truth(objects, kVoxel_m, kScoredBox);
  const auto see = [&](float x, float y, float z) {
    const Eigen::Vector3f point(x, y, z);
    const float t = (1.05F - kEye.x()) / (x - kEye.x());  // where it passes the rod
    const bool is_at_rod = t > 0.0F && t < 0.99F && std::abs(t * (y - 0.05F)) < 0.25F;
    for (int i = 0; i < Truth::kEnoughLines && !is_at_rod; ++i) truth.add({kEye, point});
  };
  for (float z = 0.02F; z < 1.6F; z += 0.04F) {
    for (float y = -1.58F; y < 1.6F; y += 0.04F) see(2.0F, y, z);
    for (float x = 0.12F; x < 2.0F; x += 0.04F) see(x, 1.6F, z);
    see(1.045F, 0.05F, z);
  }
  return truth;
}

Claims perfect_claims(const Truth& truth) {
  Claims claims(kScoredBox, Occupancy::kUnknown);
  truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth& voxel) {
    if (voxel.holds == Holds::kSolid && voxel.hits > 0) {
      claims.at(v) = Occupancy::kOccupied;
    } else if (voxel.holds == Holds::kNothing && voxel.through > 0) {
      claims.at(v) = Occupancy::kFree;
    }
  });
  return claims;
}

/// A map to be spoilt by the test.
class Scores : public ::testing::Test {
 protected:
  static const Truth& truth() {
    static const Truth made = make_truth();
    return made;
  }
  static std::vector<ThinVoxel> seen_thin() {
    auto voxels = thin_voxels(truth());
    for (ThinVoxel& voxel : voxels) voxel.nearest_m = 1.0F;
    return voxels;
  }

  [[nodiscard]] std::map<std::string, double> values() const {
    std::map<std::string, double> by_name;
    for (const auto& score : scores()) {
      for (const ScoreValue& value : judge(score).values) by_name[value.name] = value.value;
    }
    return by_name;
  }
  [[nodiscard]] ScoreResult judge(const Registered<ComputeScore>& score) const {
    const std::vector<ThinVoxel> thin = seen_thin();
    return score.make({truth(), claims_, ever_, &reference_, 60.0, thin});
  }
  [[nodiscard]] std::vector<Finding> findings() const {
    return judge(find_registered(scores(), "free", "score").value()).findings;
  }
  /// The names of the scores that differ from those of the perfect map.
  [[nodiscard]] std::set<std::string> moved() const {
    std::set<std::string> names;
    for (const auto& [name, value] : values()) {
      if (perfect_.at(name) != value) names.insert(name);
    }
    return names;
  }

  const Claims reference_ = perfect_claims(truth());
  Claims claims_ = reference_;
  DenseGrid<std::uint8_t> ever_{kScoredBox, 0};
  const std::map<std::string, double> perfect_ = values();

  const VoxelIndex wall_{20, -8, 8};   // of the front wall, in the middle of what is seen
  const VoxelIndex air_{10, -4, 8};    // looked through, far from everything
  const VoxelIndex behind_{24, 0, 8};  // behind the wall, two voxels from what was seen
  const VoxelIndex rod_{10, 0, 8};
};

TEST_F(Scores, a_perfect_map_has_full_marks) {
  for (const auto& [name, value] : perfect_) {
    if (name.starts_with("surface offset")) continue;
    const bool is_share_of_right = name.find("recall") != std::string::npos ||
                                   name.find("precision") != std::string::npos ||
                                   name.find("honesty") != std::string::npos ||
                                   name.find("within half") != std::string::npos ||
                                   name == "near surfaces: seen solid voxels called occupied";
    EXPECT_NEAR(value, is_share_of_right ? 1.0 : 0.0, 1e-12) << name;
  }
  EXPECT_THAT(findings(), IsEmpty());
  // A voxel's middle lies half a voxel behind its face.
  EXPECT_NEAR(perfect_.at("surface offset, |mean|"), 0.5 * kVoxel_m, 0.02);
}

TEST_F(Scores, hold_every_registered_score_to_this_map) {
  for (const auto& score : scores()) {
    if (score.name == "movers") continue;  // nothing moves here; see reaction_test.cpp
    EXPECT_FALSE(judge(score).values.empty()) << score.name;
  }
  EXPECT_EQ(perfect_.count("corner angles off, mean"), 1U) << "two walls meet";
}

TEST_F(Scores, a_phantom_costs_precision_and_blocks_the_view) {
  claims_.at(air_) = Occupancy::kOccupied;
  ever_.at(air_) = 1;
  EXPECT_THAT(moved(),
              UnorderedElementsAre(
                  "occupied precision, exact", "occupied precision, within 1 voxel", "free recall",
                  "known voxels: empty ones called occupied", "phantom voxels at the end",
                  "phantom voxels at any time", "lines of sight blocked early",
                  "surface offset, |mean|", "surface offset, RMS"))
      << "offsets are of the lines that are not blocked";
  EXPECT_EQ(values().at("phantom voxels at the end"), 1.0) << "a minute was flown";
}

TEST_F(Scores, a_phantom_that_went_away_was_still_there) {
  ever_.at(air_) = 1;
  EXPECT_THAT(moved(), UnorderedElementsAre("phantom voxels at any time"));
}

TEST_F(Scores, a_fat_wall_costs_exact_precision_only) {
  VoxelIndex front = wall_;
  --front.x;
  claims_.at(front) = Occupancy::kOccupied;
  ever_.at(front) = 1;
  EXPECT_THAT(moved(),
              ::testing::IsSupersetOf(Names{"occupied precision, exact", "free recall",
                                            "known voxels: empty ones called occupied",
                                            "near surfaces: empty voxels called occupied"}));
  EXPECT_EQ(moved().count("occupied precision, within 1 voxel"), 0U);
  EXPECT_EQ(moved().count("phantom voxels at any time"), 0U);
}

TEST_F(Scores, a_hole_in_a_wall_costs_exact_recall_and_lets_lines_of_sight_pass) {
  claims_.at(wall_) = Occupancy::kUnknown;
  EXPECT_THAT(moved(),
              ::testing::IsSupersetOf(Names{"occupied recall, exact",
                                            "near surfaces: seen solid voxels called occupied"}));
  EXPECT_EQ(moved().count("occupied recall, within 1 voxel"), 0U);
  EXPECT_EQ(moved().count("free precision"), 0U);
  const auto voxels = static_cast<double>(reference_.size());
  EXPECT_GT(values().at("occupied recall, exact"), 1.0 - 0.01);
  EXPECT_LT(values().at("occupied recall, exact"), 1.0 - 1.0 / voxels);
}

TEST_F(Scores, a_solid_voxel_called_free_is_listed_with_what_is_there) {
  claims_.at(rod_) = Occupancy::kFree;
  const auto found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].voxel, rod_);
  EXPECT_EQ(found[0].what, "rod (10 mm thin)");
  EXPECT_TRUE(found[0].is_warned) << "the rest of the rod is there";
  EXPECT_EQ(values().at("solid voxels called free"), 1.0);
  EXPECT_LT(values().at("free precision"), 1.0);
}

TEST_F(Scores, nobody_is_warned_of_a_rod_that_is_gone_altogether) {
  for (VoxelIndex v = rod_; v.z >= 0; --v.z) claims_.at(v) = Occupancy::kFree;
  for (VoxelIndex v = rod_; v.z < 16; ++v.z) claims_.at(v) = Occupancy::kFree;
  EXPECT_EQ(values().at("of these, without an occupied neighbour"), 16.0);
  EXPECT_EQ(values().at("thin 10 mm at 1 m: recall, within 1 voxel"), 0.0);
}

TEST_F(Scores, half_a_rod_is_half_of_its_recall) {
  for (VoxelIndex v = rod_; v.z < 16; ++v.z) claims_.at(v) = Occupancy::kUnknown;
  EXPECT_EQ(values().at("thin 10 mm at 1 m: recall, exact"), 0.5);
  EXPECT_EQ(values().at("thin 10 mm at 1 m: recall, within 1 voxel"), 9.0 / 16.0);
}

TEST_F(Scores, a_claim_about_what_nobody_saw_costs_honesty_only) {
  claims_.at(behind_) = Occupancy::kFree;
  EXPECT_THAT(moved(), UnorderedElementsAre("unknown honesty", "never-seen voxels called free"));
  claims_.at(behind_) = Occupancy::kOccupied;
  EXPECT_EQ(moved().count("never-seen voxels called free"), 0U);
  EXPECT_EQ(moved().count("unknown honesty"), 1U);
}

TEST_F(Scores, a_wall_that_is_turned_shows_in_the_angle_of_its_corner) {
  // Columns step forward by a voxel every 0.8 m: atan(0.1 / 0.8) = 7 degrees.
  for (int y = -16; y < 16; ++y) {
    for (int z = 0; z < 16; ++z) {
      if (claims_.at({20, y, z}) != Occupancy::kOccupied) continue;
      claims_.at({20, y, z}) = Occupancy::kUnknown;
      claims_.at({20 + (y < -8 ? 2 : y < 0 ? 1 : y < 8 ? 0 : -1), y, z}) = Occupancy::kOccupied;
    }
  }
  EXPECT_NEAR(values().at("corner angles off, worst"), 7.0, 1.0);
  EXPECT_GT(values().at("wall straightness, RMS of the worst wall"), 0.02);
}

TEST_F(Scores, what_stands_before_a_wall_is_not_the_wall) {
  auto objects = corner();
  objects.push_back({"cupboard", sim::Box{{1.75, -1.2, 0.8}, {0.1, 0.4, 1.6}}});
  const Truth furnished = make_truth(objects);
  for (int z = 0; z < 16; ++z) {
    // In a right map it is one voxel wider than it is, as many are.
    for (int y = -15; y < -9; ++y) claims_.at({17, y, z}) = Occupancy::kOccupied;
  }
  const auto walls = find_registered(scores(), "walls", "score").value();
  for (const ScoreValue& value : walls.make({furnished, claims_, ever_, nullptr, 60.0}).values)
    EXPECT_NEAR(value.value, value.higher_is_better ? 1.0 : 0.0, 1e-12) << value.name;
}

TEST_F(Scores, voxels_where_something_moves_are_left_out) {
  Truth swept = make_truth();
  swept.mark_swept(air_);
  claims_.at(air_) = Occupancy::kOccupied;
  ever_.at(air_) = 1;
  const auto occupied = find_registered(scores(), "occupied", "score").value();
  const auto result = occupied.make({swept, claims_, ever_, nullptr, 60.0});
  EXPECT_EQ(result.values[0].value, 1.0);
}

TEST(Truth, a_rug_is_a_sliver_on_the_floor_and_a_shelf_is_solid_in_the_air) {
  const std::vector<sim::Object> objects{
      {"floor", sim::Box{{0, 0, -0.1}, {2, 2, 0.2}}},
      {"rug", sim::Box{{0, 0, 0.006}, {1, 1, 0.012}}},
      {"shelf", sim::Box{{0, 0, 0.55}, {1, 1, 0.02}}},
      {"leg", sim::Cylinder{{0.75, 0.75, 0.0}, {0.75, 0.75, 0.4}, 0.02}}};
  const Truth truth(objects, kVoxel_m, {{-10, -10, -2}, {9, 9, 9}});
  EXPECT_EQ(truth.voxels().at({0, 0, 0}).holds, Holds::kSliver);
  EXPECT_EQ(truth.name_at({0, 0, 0}), "rug");
  EXPECT_EQ(truth.voxels().at({0, 0, 5}).holds, Holds::kSolid);
  EXPECT_EQ(truth.voxels().at({7, 7, 0}).holds, Holds::kSolid) << "it stands on the floor";
  EXPECT_EQ(truth.name_at({7, 7, 0}), "leg (20 mm thin)");
}

TEST(LeaveOut, a_point_at_an_occupied_voxel_is_met_and_a_ray_through_one_is_blocked) {
  const std::vector<SightLine> lines{{{0.05F, 0.05F, 0.05F}, {1.05F, 0.05F, 0.05F}}};
  Claims claims(box_around(lines, kVoxel_m), Occupancy::kFree);
  EXPECT_EQ(consistency_of(claims, lines, kVoxel_m).met, 0U);
  claims.at({9, 1, 0}) = Occupancy::kOccupied;  // beside it
  EXPECT_EQ(consistency_of(claims, lines, kVoxel_m).met, 1U);
  EXPECT_EQ(consistency_of(claims, lines, kVoxel_m).blocked, 0U);
  claims.at({8, 0, 0}) = Occupancy::kOccupied;  // two voxels before: its own surface
  EXPECT_EQ(consistency_of(claims, lines, kVoxel_m).blocked, 0U);
  claims.at({7, 0, 0}) = Occupancy::kOccupied;
  EXPECT_EQ(consistency_of(claims, lines, kVoxel_m).blocked_share(), 1.0);
}

TEST(LeaveOut, keeps_every_fifth_frame_from_the_map) {
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < 100; ++i) left_out += is_left_out(i) ? 1 : 0;
  EXPECT_EQ(left_out, 20U);
  EXPECT_FALSE(is_left_out(0));
}

}  // namespace
}  // namespace swiftlet::eval
