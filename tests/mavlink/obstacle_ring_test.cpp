// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/ring/obstacle_ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "mavlink/receiver_model.hpp"
#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/base/angle.hpp"
#include "swiftlet/mavlink/ring/ring_message.hpp"

namespace swiftlet::mavlink {
namespace {

using test::Belief;
using test::HandMadeMap;
using test::Random;

constexpr double kRingVoxel_m = 0.25;
constexpr RingOptions kOptions{
    .body_radius_m = 0.3, .body_height_m = 0.3, .margin_m = 0.2, .max_m = 3.5, .blind_m = 0.6};
constexpr RingTelling kTelling{.max_m = kOptions.max_m, .least_known_m = 1.2};

/// Blocks that are free, unknown or mixed, and here and there matter.
void scatter(Random& random, HandMadeMap& map) {
  map.map().clear();
  map.map().recentre(Eigen::Vector3d::Zero(), nullptr);
  const double matter = random.chance(0.3) ? 0.0 : random.real(0, 0.01);
  const double unknown = random.chance(0.4) ? 0.0 : random.real(0, 0.01);
  for_each_block(map.map().window(), [&](const BlockIndex& b) {
    if (random.chance(0.05)) return;
    auto& voxels = map.map().writable(b).voxels;
    voxels.fill(test::kFree);
    for (auto left = static_cast<int>(matter * 512 + random.real(0, 1)); left > 0; --left)
      voxels[random.integer<std::size_t>(0, 511)] = test::kOccupied;
    for (auto left = static_cast<int>(unknown * 512 + random.real(0, 1)); left > 0; --left)
      voxels[random.integer<std::size_t>(0, 511)] = kUnknownVoxel;
  });
}

Transform<World, Body> random_pose(Random& random) {
  const Eigen::AngleAxisd yaw(random.real(-4, 4), Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd tilt(
      random.real(-0.6, 0.6),
      Eigen::Vector3d(random.gaussian(1), random.gaussian(1), 0).normalized());
  return Transform<World, Body>::trusted(
      Eigen::Quaterniond(yaw * tilt),
      {random.real(-1, 1), random.real(-1, 1), random.real(-0.5, 0.5)});
}

/// How high and low the points of the body's rim lie, found by turning many of them.
std::pair<double, double> rim(const Transform<World, Body>& T_world_body) {
  double low = 1e9, high = -1e9;
  for (int i = 0; i < 64; ++i) {
    const double a = radians(360.0 * i / 64);
    for (const double z : {-0.5, 0.5}) {
      const Eigen::Vector3d p(kOptions.body_radius_m * std::cos(a),
                              kOptions.body_radius_m * std::sin(a), z * kOptions.body_height_m);
      low = std::min(low, (T_world_body * p).z());
      high = std::max(high, (T_world_body * p).z());
    }
  }
  return {low, high};
}

/// A point as the vehicle sees it from above.
struct Sight {
  double distance_m;
  double clockwise_deg;
};
Sight seen_from(const Transform<World, Body>& T_world_body, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d nose = T_world_body.rotation() * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d to = p_world - T_world_body.translation();
  return {std::hypot(to.x(), to.y()),
          degrees(std::atan2(nose.y(), nose.x()) - std::atan2(to.y(), to.x()))};
}

/// Draws points of space, and holds what receivers believe of their direction against the map.
class Witness {
 public:
  Witness(const MapSnapshot& map, const Transform<World, Body>& T_world_body)
      : map_(map), T_world_body_(T_world_body) {
    const ObstacleRing ring = look_around(map, T_world_body, kOptions);
    for (test::ReceiverModel* model :
         {static_cast<test::ReceiverModel*>(&px4_36_), static_cast<test::ReceiverModel*>(&px4_72_)})
      model->take(obstacle_distance(ring, kTelling, RingReader::kPx4, 0));
    ardupilot_.take(obstacle_distance(ring, kTelling, RingReader::kArduPilot, 0));
    std::tie(low_, high_) = rim(T_world_body);
  }

  /// True if there is a claim to check at this point.
  bool check(Random& random) {
    const double r = kOptions.max_m * std::sqrt(random.real(0, 1));
    const double a = random.real(-4, 4);
    Eigen::Vector3d p =
        T_world_body_.translation() + Eigen::Vector3d(r * std::cos(a), r * std::sin(a), 0);
    p.z() = random.real(low_ - kOptions.margin_m, high_ + kOptions.margin_m);
    const Occupancy state = map_.occupancy(p);
    const Sight sight = seen_from(T_world_body_, p);
    if (state == Occupancy::kOccupied) check_matter(sight);
    const bool is_level_with_body = p.z() >= low_ && p.z() <= high_;
    // The voxel's middle, by which the ring judges, is at most half a diagonal away.
    const bool is_far = sight.distance_m > kOptions.blind_m + kRingVoxel_m * std::sqrt(0.5);
    if (state == Occupancy::kUnknown && is_level_with_body && is_far) check_unknown(sight);
    return state != Occupancy::kFree;
  }

 private:
  void check_matter(const Sight& sight) const {
    for (const test::ReceiverModel* model :
         {static_cast<const test::ReceiverModel*>(&px4_36_),
          static_cast<const test::ReceiverModel*>(&px4_72_),
          static_cast<const test::ReceiverModel*>(&ardupilot_)}) {
      const Belief belief = model->at(sight.clockwise_deg);
      const bool is_safe = (belief.kind == Belief::Kind::kObstacle &&
                            belief.distance_cm <= 100 * sight.distance_m + 1) ||
                           (belief.kind == Belief::Kind::kUnknown && model != &ardupilot_);
      ASSERT_TRUE(is_safe) << "matter at " << sight.distance_m << " m, " << sight.clockwise_deg
                           << " deg; believed " << belief.distance_cm << " cm";
    }
  }

  void check_unknown(const Sight& sight) const {
    ASSERT_NE(px4_36_.at(sight.clockwise_deg).kind, Belief::Kind::kFree) << sight.clockwise_deg;
    const Belief belief = px4_72_.at(sight.clockwise_deg);
    ASSERT_NE(belief.kind, Belief::Kind::kFree) << sight.clockwise_deg;
    const bool is_obstacle = belief.kind == Belief::Kind::kObstacle;
    ASSERT_FALSE(is_obstacle && belief.distance_cm > 100 * sight.distance_m + 1)
        << sight.clockwise_deg;
  }

  const MapSnapshot& map_;
  const Transform<World, Body> T_world_body_;
  test::Px4With36Bins px4_36_;
  test::Px4With72Bins px4_72_;
  test::ArduPilotFaces ardupilot_;
  double low_ = 0, high_ = 0;
};

TEST(ObstacleRing, never_tells_a_receiver_of_matter_too_far_nor_of_the_unknown_as_free) {
  HandMadeMap map(kRingVoxel_m, {6, 6, 2});
  std::size_t checked = 0;
  test::for_each_seed(2'000, [&](Random& random) {
    scatter(random, map);
    const MapSnapshot snapshot = map.snapshot();
    for (int pose = 0; pose < 5 && !::testing::Test::HasFatalFailure(); ++pose) {
      Witness witness(snapshot, random_pose(random));
      for (int i = 0; i < 300; ++i) checked += witness.check(random) ? 1 : 0;
    }
  });
  EXPECT_GT(checked, std::getenv("SWIFTLET_TEST_SEED") == nullptr ? 100'000U : 0U);
}

TEST(ObstacleRing, sees_a_post_in_the_sector_where_it_stands_at_its_near_face) {
  for (const double heading_deg : {0.0, 90.0, -135.0, 180.0}) {
    for (const int sector : {0, 3, 18, 36, 54, 71}) {
      HandMadeMap map(0.1, {6, 6, 2});
      map.fill_window(test::kFree);
      const double angle = radians(heading_deg - 5.0 * sector);
      map.set_at({2 * std::cos(angle), 2 * std::sin(angle), 0.02}, test::kOccupied);
      const auto T_world_body = Transform<World, Body>::trusted(
          Eigen::Quaterniond(Eigen::AngleAxisd(radians(heading_deg), Eigen::Vector3d::UnitZ())),
          {0.01, 0.01, 0});
      const ObstacleRing ring = look_around(map.snapshot(), T_world_body, kOptions);
      for (int i = 0; i < 72; ++i) {
        const double occupied_m = ring.sectors[static_cast<std::size_t>(i)].occupied_m;
        const int apart = std::abs((i - sector + 36 + 72) % 72 - 36);
        if (apart == 0) {
          EXPECT_NEAR(occupied_m, 2.0, 0.15) << heading_deg << " " << sector;
        } else if (apart > 1) {
          EXPECT_EQ(occupied_m, SectorView::kNone) << heading_deg << " " << i;
        }
      }
    }
  }
}

TEST(ObstacleRing, looks_at_the_height_of_the_body_and_its_margin_alone) {
  HandMadeMap map(0.1, {6, 6, 3});
  map.fill_window(test::kFree);
  map.fill({1, -0.3, 0.46}, {1, 0.3, 0.46}, test::kOccupied);  // above: 0.15 + 0.2 + a voxel
  map.fill({2, -0.3, 0.32}, {2, 0.3, 0.32}, test::kOccupied);  // within the margin
  const Transform<World, Body> level;
  EXPECT_NEAR(look_around(map.snapshot(), level, kOptions).sectors[0].occupied_m, 2.0, 0.1);
  // Tilted by half a radian the rim stands 0.15 higher: the nearer one is in the way.
  const auto tilted = Transform<World, Body>::trusted(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY())), {0, 0, 0});
  EXPECT_NEAR(look_around(map.snapshot(), tilted, kOptions).sectors[0].occupied_m, 1.0, 0.1);
}

TEST(ObstacleRing, takes_what_lies_outside_the_window_for_unknown) {
  HandMadeMap map(0.25, {6, 6, 2});
  map.fill_window(test::kFree);
  RingOptions far = kOptions;
  far.max_m = 50;
  const ObstacleRing ring = look_around(map.snapshot(), {}, far);
  for (const SectorView& view : ring.sectors) {
    EXPECT_EQ(view.occupied_m, SectorView::kNone);
    EXPECT_GT(view.unknown_m, 2.9);
    EXPECT_LT(view.unknown_m, 8.0);
  }
}

}  // namespace
}  // namespace swiftlet::mavlink
