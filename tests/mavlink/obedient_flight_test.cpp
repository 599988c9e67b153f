// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mavlink/receiver_model.hpp"
#include "mavlink/recording_outlet.hpp"
#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/base/angle.hpp"
#include "swiftlet/mavlink/companion/companion.hpp"

namespace swiftlet::mavlink {
namespace {

using namespace std::chrono_literals;
using test::Random;

constexpr double kVoxel_m = 0.2;
constexpr double kKeep_m = 1.0;   // CP_DIST
constexpr double kDelay_s = 0.4;  // CP_DELAY: image to message, and that the message is 66 ms old
constexpr double kGain = 0.95;    // MPC_XY_P
constexpr double kTop_mps = 4.0;  // the pilot pushes full forward
constexpr double kBrake_mps2 = 5.0;

/// A vehicle that knows nothing but OBSTACLE_DISTANCE and stops as PX4's collision prevention does:
/// in every direction slower than kGain times what is left to kKeep_m, and nowhere where nothing is
/// known. Distances that are 0.5 s old count no more.
class ObedientVehicle {
 public:
  void take(const ObstacleDistance& message, HostTime now) {
    model_.take(message);
    heard_ = now;
  }
  /// The speed that is left of what the pilot wants, ahead.
  [[nodiscard]] double allowed(double speed_mps, HostTime now) const {
    if (!heard_ || now - *heard_ > 500ms) return 0;
    double most = kTop_mps;
    for (int sector = 0; sector < 72; ++sector) {
      const double deg = 5.0 * sector;
      const double towards = std::cos(radians(deg));
      const test::Belief belief = model_.at(deg);
      if (sector == 0 && belief.kind == test::Belief::Kind::kUnknown) return 0;
      if (towards <= 0 || belief.kind != test::Belief::Kind::kObstacle) continue;
      const double left_m = belief.distance_cm / 100 - kKeep_m - kDelay_s * speed_mps * towards;
      most = std::min(most, kGain * std::max(left_m, 0.0) / towards);
    }
    return most;
  }

 private:
  test::Px4With72Bins model_;
  std::optional<HostTime> heard_;
};

/// Boxes around a clear start, in a map that knows all of it.
std::vector<Eigen::AlignedBox2d> scatter_walls(Random& random, test::HandMadeMap& map) {
  map.map().clear();
  map.map().recentre(Eigen::Vector3d::Zero(), nullptr);
  map.fill_window(test::kFree);
  std::vector<Eigen::AlignedBox2d> walls;
  for (int i = random.integer(1, 6); i > 0; --i) {
    const double angle = random.real(-3.2, 3.2), distance_m = random.real(2.5, 7);
    const Eigen::Vector2d middle(distance_m * std::cos(angle), distance_m * std::sin(angle));
    const Eigen::Vector2d half(random.real(0.05, 1.0), random.real(0.05, 1.0));
    if (middle.norm() - half.norm() < 1.6) continue;
    map.fill({middle.x() - half.x(), middle.y() - half.y(), -1},
             {middle.x() + half.x(), middle.y() + half.y(), 1}, test::kOccupied);
    walls.emplace_back(middle - half, middle + half);
  }
  return walls;
}

double distance_to(const std::vector<Eigen::AlignedBox2d>& walls, const Eigen::Vector2d& p) {
  double nearest = 1e9;
  for (const auto& wall : walls) nearest = std::min(nearest, wall.exteriorDistance(p));
  return nearest;
}

TEST(ObedientFlight, never_comes_nearer_to_a_wall_than_it_must_keep_however_the_pilot_pushes) {
  test::HandMadeMap map(kVoxel_m, {18, 18, 3});
  double nearest = 1e9;
  int stopped = 0;
  test::for_each_seed(50, [&](Random& random) {
    const auto walls = scatter_walls(random, map);
    FlightNews news;
    Companion companion({.ring = {.max_m = 8}}, news);
    auto reader = map.map().reader();
    map.map().publish({1});
    news.map_begun(std::move(reader));
    test::RecordingOutlet out;
    ObedientVehicle vehicle;
    const double heading = random.real(-3.2, 3.2);
    const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    double speed_mps = 0;
    std::size_t heard = 0;
    for (int step = 0; step < 2'000; ++step) {
      out.now = HostTime{100s} + step * 5ms;
      if (step % 6 == 0) {  // a frame each 30 ms, 40 ms after it was taken
        const Eigen::Vector2d then = p - 0.04 * speed_mps * ahead;
        news.mapped({.T_world_body = Transform<World, Body>::trusted(
                         Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())),
                         {then.x(), then.y(), 0}),
                     .taken_at = out.now - 40ms});
      }
      companion.tick(out.now, out);
      const auto rings = out.all<ObstacleDistance>(out.now);
      heard += rings.size();
      if (!rings.empty()) vehicle.take(rings.back(), out.now);
      const double wanted = vehicle.allowed(speed_mps, out.now);
      speed_mps =
          std::max(std::min(wanted, speed_mps + 0.005 * 3), speed_mps - 0.005 * kBrake_mps2);
      p += 0.005 * speed_mps * ahead;
      const double left_m = distance_to(walls, p);
      nearest = std::min(nearest, left_m);
      ASSERT_GE(left_m, kKeep_m - kVoxel_m) << "at " << speed_mps << " m/s";
      if (p.norm() > 8.5) break;
    }
    EXPECT_GT(heard, 0U);
    stopped += speed_mps < 0.05 ? 1 : 0;
  });
  ::testing::Test::RecordProperty("nearest_mm", static_cast<int>(1000 * nearest));
  const bool is_repeated = std::getenv("SWIFTLET_TEST_SEED") != nullptr;
  EXPECT_GT(stopped, is_repeated ? -1 : 10);
}

}  // namespace
}  // namespace swiftlet::mavlink
