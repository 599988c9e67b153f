// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Random bodies on random paths through random maps, judged by plain geometry at many places along
// the path: every voxel that is not free, tried one by one.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "query/round_solid.hpp"
#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {
namespace {

using test::gap_by_hand;
using test::HandMadeMap;
using test::Placed;
using test::Random;
using test::random_solid;
using test::Solid;
using Vector = Eigen::Vector3d;

constexpr double kLawVoxel_m = 0.1;
const double kLawDiagonal_m = std::sqrt(3.0) * kLawVoxel_m;

/// The search of gap_by_hand() ends here, and a sweep leaves out nothing that is as near.
constexpr double kTouch_m = 1e-8;

Transform<World, Body> between(const TimedPose& a, const TimedPose& b, double share) {
  const auto &from = a.T_world_body, &to = b.T_world_body;
  return Transform<World, Body>::trusted(
      from.rotation().slerp(share, to.rotation()).normalized(),
      from.translation() + share * (to.translation() - from.translation()));
}

struct World3 {
  HandMadeMap made{kLawVoxel_m, {2.4, 2.4, 1.6}};
  std::vector<VoxelIndex> not_free;
  std::optional<MapSnapshot> map;
};

void fill_randomly(World3& world, Random& random) {
  world.made.fill_window(test::kFree);
  const VoxelBox box = voxel_box(world.made.map().window());
  const int count = random.chance(0.5) ? 12 : 120;
  for (int i = 0; i < count; ++i) {
    const VoxelIndex v{random.integer(box.first.x, box.last.x),
                       random.integer(box.first.y, box.last.y),
                       random.integer(box.first.z, box.last.z)};
    world.made.set(v, random.chance(0.5) ? test::kOccupied : kUnknownVoxel);
    world.not_free.push_back(v);
  }
  world.map = world.made.snapshot();
}

std::vector<TimedPose> random_path(Random& random) {
  std::vector<TimedPose> poses;
  const int count = random.integer(1, 4);
  const double step = random.chance(0.5) ? 0.15 : 1.5;
  const bool turns = random.chance(0.6);
  Vector p = random.vector(-1.2, 1.2);
  p.z() *= 0.6;
  for (int i = 0; i < count; ++i) {
    const auto R = turns ? random.rotation() : Eigen::Quaterniond::Identity();
    poses.push_back({{1000 * i}, Transform<World, Body>::trusted(R, p)});
    p += random.vector(-step, step);
  }
  return poses;
}

/// The places where bodies are tried: every leg in so many steps.
template <class Visit>
void along(const std::vector<TimedPose>& poses, int steps, Visit&& visit) {
  const std::size_t legs = std::max<std::size_t>(poses.size() - 1, 1);
  for (std::size_t leg = 0; leg < legs; ++leg) {
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      visit(leg, share, between(poses[leg], poses[std::min(leg + 1, poses.size() - 1)], share));
    }
  }
}

Vector low_corner(const VoxelIndex& v) { return Vector(v.x, v.y, v.z) * kLawVoxel_m; }

/// A contact stands at its place: before the one that plain geometry has found.
void expect_not_late(const std::optional<SweepContact>& contact, std::size_t leg, double share) {
  ASSERT_TRUE(contact) << "on leg " << leg << " at " << share;
  EXPECT_LE(static_cast<double>(contact->leg) + contact->leg_share,
            static_cast<double>(leg) + share + 1e-9);
}

void expect_no_voxel_is_missed(const World3& world, const Solid& solid,
                               const std::vector<TimedPose>& poses, const SweepAnswer& answer) {
  const double around = solid.half.norm() + solid.radius + kLawDiagonal_m;
  along(poses, 7, [&](std::size_t leg, double share, const Transform<World, Body>& T) {
    if (::testing::Test::HasFailure()) return;
    const Placed placed(solid, T);
    const Vector& middle = placed.centre;
    for (const VoxelIndex& v : world.not_free) {
      if ((low_corner(v) - middle).squaredNorm() > around * around) continue;
      if (gap_by_hand(placed, low_corner(v), kLawVoxel_m) > kTouch_m) continue;
      const bool is_unknown = world.map->log_odds(v) == kUnknownVoxel;
      expect_not_late(is_unknown ? answer.unknown : answer.occupied, leg, share);
    }
    const BlockWindow& window = world.map->window();
    const Vector first = low_corner(first_voxel(window.first));
    const Vector end = low_corner(first_voxel(window.end()));
    const Eigen::Array3d reach = placed.R.cwiseAbs() * solid.half + Vector::Constant(solid.radius);
    const bool is_out = ((middle.array() - reach) < first.array()).any() ||
                        ((middle.array() + reach) > end.array()).any();
    if (is_out) expect_not_late(answer.unknown, leg, share);
  });
}

/// What is called a contact is one: at that place, the body grown by a diagonal touches that voxel.
void expect_contact_is_real(const World3& world, const Solid& solid,
                            const std::vector<TimedPose>& poses, const SweepContact& contact) {
  EXPECT_EQ(OccupancyThresholds{}.classify(world.map->log_odds(contact.voxel)), contact.state);
  const std::size_t next = std::min(contact.leg + 1, poses.size() - 1);
  const auto T = between(poses[contact.leg], poses[next], contact.leg_share);
  EXPECT_LE(gap_by_hand(Placed(solid, T), low_corner(contact.voxel), kLawVoxel_m), kLawDiagonal_m);
}

TEST(SweepLaw, never_misses_a_voxel_that_the_body_touches_and_never_invents_one) {
  constexpr int kWorlds = 500, kBodies = 200;  // 10^5 sweeps
  Random random;
  std::array<int, 3> met{};
  for (int w = 0; w < kWorlds && !HasFailure(); ++w) {
    World3 world;
    fill_randomly(world, random);
    for (int i = 0; i < kBodies && !HasFailure(); ++i) {
      SCOPED_TRACE(::testing::Message() << random.repeat() << ", world " << w << ", body " << i);
      const Solid solid = random_solid(random);
      const std::vector<TimedPose> poses = random_path(random);
      const auto answer = sweep(*world.map, solid.shape(), *SweepPath::of(poses));
      ASSERT_TRUE(answer);
      ++met[static_cast<std::size_t>(answer->state)];
      expect_no_voxel_is_missed(world, solid, poses, *answer);
      for (const auto& contact : {answer->unknown, answer->occupied})
        if (contact) expect_contact_is_real(world, solid, poses, *contact);
    }
  }
  for (const int n : met) EXPECT_GT(n, 3000);  // each kind of answer was put to the test
}

TEST(SweepLaw, clearance_is_never_more_than_what_plain_geometry_finds_and_hardly_less) {
  Random random;
  int compared = 0;
  for (int w = 0; w < 40; ++w) {
    World3 world;
    fill_randomly(world, random);
    for (int i = 0; i < 25 && !HasFailure(); ++i) {
      SCOPED_TRACE(::testing::Message() << random.repeat() << ", world " << w << ", body " << i);
      const Solid solid = random_solid(random);
      const std::vector<TimedPose> poses = random_path(random);
      constexpr double kReach = 0.5;
      const SweepPolicy policy{.unknown = UnknownSpace::kPasses, .clearance_reach_m = kReach};
      const auto answer = sweep(*world.map, solid.shape(), *SweepPath::of(poses), policy);
      double least = kReach;
      along(poses, 100, [&](std::size_t, double, const Transform<World, Body>& T) {
        const Placed placed(solid, T);
        for (const VoxelIndex& v : world.not_free) {
          if (world.map->log_odds(v) == kUnknownVoxel) continue;
          const double around = solid.half.norm() + solid.radius + kLawDiagonal_m + least;
          if ((low_corner(v) - placed.centre).squaredNorm() > around * around) continue;
          least = std::min(least, gap_by_hand(placed, low_corner(v), kLawVoxel_m));
        }
      });
      ASSERT_LE(answer->clearance->at_least_m, least + 1e-6);
      // A quarter of a voxel for the turn within a piece; steps of the reference are up to 1.5
      // voxels and, turning, half a voxel more.
      ASSERT_GE(answer->clearance->at_least_m, least - 0.8 * kLawVoxel_m);
      compared += least < kReach ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 300);
}

/// Numbers at the edges of what is allowed, and beyond.
double wild_number(Random& random) {
  constexpr std::array<double, 14> kNumbers{0.0,
                                            -0.0,
                                            1e-300,
                                            1e-12,
                                            0.1,
                                            -0.8,
                                            3.2,
                                            1e3,
                                            -1e5,
                                            999999.0,
                                            1e6,
                                            1e308,
                                            std::numeric_limits<double>::quiet_NaN(),
                                            std::numeric_limits<double>::infinity()};
  const double n = kNumbers[random.integer<std::size_t>(0, kNumbers.size() - 1)];
  return random.chance(0.3) ? random.real(-2.0, 2.0) : n;
}
Vector wild_vector(Random& random) {
  Vector v;
  for (double& part : v) part = wild_number(random);
  return v;
}

TEST(SweepLaw, every_extreme_gets_an_answer_or_an_error) {
  Random random;
  World3 world;
  fill_randomly(world, random);
  int answers = 0, errors = 0;
  for (int i = 0; i < 100000; ++i) {
    SCOPED_TRACE(::testing::Message() << random.repeat() << ", case " << i);
    const int kind = random.integer(0, 2);
    const auto body = kind == 0   ? BodyShape::sphere(wild_number(random), wild_vector(random))
                      : kind == 1 ? BodyShape::capsule(wild_vector(random), wild_vector(random),
                                                       wild_number(random))
                                  : BodyShape::box(wild_vector(random));
    std::vector<Vector> points(random.integer<std::size_t>(0, 3));
    for (Vector& p : points) p = wild_vector(random);
    const auto path = SweepPath::along(points);
    if (!body || !path) {
      ++errors;
      continue;
    }
    const SweepPolicy policy{
        .unknown = random.chance(0.5) ? UnknownSpace::kStops : UnknownSpace::kPasses,
        .margin_m = std::abs(wild_number(random)),
        .clearance_reach_m = random.chance(0.5) ? 0.0 : std::abs(wild_number(random))};
    const auto answer = sweep(*world.map, *body, *path, policy);
    (answer ? answers : errors) += 1;
    if (!answer) continue;
    ASSERT_TRUE(std::isfinite(answer->clear_m));
    ASSERT_LE(answer->clear_m, answer->length_m);
    ASSERT_EQ(answer->state == SweepState::kClear, !answer->unknown && !answer->occupied);
  }
  EXPECT_GT(answers, 300);
  EXPECT_GT(errors, 10000);
}

}  // namespace
}  // namespace swiftlet
