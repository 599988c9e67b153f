// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/upkeep/occupancy_decay.hpp"

#include <gtest/gtest.h>

#include "support/map_bits.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet {
namespace {

constexpr double kDecay_s = 1.0;
constexpr std::int64_t kFrame_ns = 33'333'333;

/// A wall 3 m ahead fills the left half of the view; before the right half something stands, or
/// nothing is seen there.
enum class OnTheRight { kNothing, kThing, kScreen };
Frame half_a_wall(OnTheRight what) {
  Frame frame = test::wall_frame(test::small_camera(160, 120), 3.1);
  const auto right = static_cast<std::uint16_t>(what == OnTheRight::kThing    ? 2100
                                                : what == OnTheRight::kScreen ? 1100
                                                                              : 0);
  for (int v = 0; v < 120; ++v) {
    for (int u = 80; u < 160; ++u) frame.depth.raw.at(u, v) = right;
  }
  return frame;
}

// 2.1 m ahead, a metre to the right; and the wall to the left.
const VoxelIndex kThingVoxel{10, -5, 0}, kWallVoxel{15, 5, 0};

class Watched {
 public:
  explicit Watched(double decay_s, const MapperConfig& base = {})
      : mapper_(created(decay_s, base)) {}

  void show(Frame frame, double for_s) {
    const auto frames = static_cast<int>(std::lround(for_s * 1e9 / kFrame_ns));
    for (int i = 0; i < frames; ++i) {
      frame.stamp = now_ = now_ + Nanoseconds(kFrame_ns);
      mapper_.integrate(frame);
    }
  }
  void wait(double for_s) { now_ = now_ + Nanoseconds(std::llround(for_s * 1e9)); }
  [[nodiscard]] QuantizedLogOdds at(const VoxelIndex& v) const { return mapper_.map().log_odds(v); }
  [[nodiscard]] Occupancy claim(const VoxelIndex& v) const {
    return mapper_.config().occupancy.classify(at(v));
  }
  [[nodiscard]] Mapper& mapper() { return mapper_; }

 private:
  static Mapper created(double decay_s, MapperConfig config) {
    config.integrate.decay_s = decay_s;
    return Mapper::create(config).value();
  }
  Mapper mapper_;
  Stamp now_;
};

TEST(OccupancyDecay, lets_go_of_what_has_left_within_its_time_and_not_before) {
  Watched map(kDecay_s);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  ASSERT_EQ(map.at(kThingVoxel), kOccupiedVoxel);
  map.show(half_a_wall(OnTheRight::kNothing), 0.5);
  // Half of the 128 steps; up to eight and those of a frame may be carried on.
  EXPECT_NEAR(map.at(kThingVoxel), kUnknownVoxel + 64, 8 + 5);
  map.show(half_a_wall(OnTheRight::kNothing), 0.5 + 0.04);
  EXPECT_EQ(map.at(kThingVoxel), kUnknownVoxel) << "unknown, and no less";
  map.show(half_a_wall(OnTheRight::kNothing), 1.0);
  EXPECT_EQ(map.at(kThingVoxel), kUnknownVoxel);
  EXPECT_EQ(map.at(kWallVoxel), kOccupiedVoxel) << "what is seen stays";
}

TEST(OccupancyDecay, switched_off_keeps_ghosts) {
  Watched map(0.0);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  map.show(half_a_wall(OnTheRight::kNothing), 10.0);
  EXPECT_EQ(map.claim(kThingVoxel), Occupancy::kOccupied);
}

TEST(OccupancyDecay, keeps_what_is_hidden) {
  Watched map(kDecay_s);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  map.show(half_a_wall(OnTheRight::kScreen), 5.0);
  EXPECT_EQ(map.at(kThingVoxel), kOccupiedVoxel);
}

TEST(OccupancyDecay, keeps_what_is_out_of_view_or_out_of_range) {
  Watched map(kDecay_s);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  Frame away = half_a_wall(OnTheRight::kNothing);
  away.T_world_camera =
      Transform<World, Body>::trusted(
          Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ())), {0, 0, 0}) *
      forward_looking_camera();
  map.show(away, 5.0);
  EXPECT_EQ(map.at(kThingVoxel), kOccupiedVoxel);

  // Farther back than max_range_m reaches, still inside the window and in view.
  Frame back = half_a_wall(OnTheRight::kNothing);
  back.T_world_camera =
      Transform<World, Body>::trusted(Eigen::Quaterniond::Identity(), {-1, 0, 0}) *
      forward_looking_camera();
  MapperConfig near;
  near.depth.max_range_m = 3.3;
  Watched short_sighted(kDecay_s, near);
  short_sighted.show(half_a_wall(OnTheRight::kThing), 1.0);
  short_sighted.show(back, 5.0);
  EXPECT_EQ(short_sighted.at(kThingVoxel), kUnknownVoxel) << "3.1 m from there: in range";
  near.depth.max_range_m = 2.9;
  Watched shorter(kDecay_s, near);
  shorter.show(half_a_wall(OnTheRight::kThing), 1.0);
  // At 2.9 m the left half has no reading at 4.1 m either: give it one.
  for (int v = 0; v < 120; ++v) back.depth.raw.at(3, v) = 2500;
  shorter.show(back, 5.0);
  EXPECT_EQ(shorter.at(kThingVoxel), kOccupiedVoxel) << "3.1 m from there: out of range";
}

TEST(OccupancyDecay, keeps_a_thing_of_which_every_third_reading_is_missing) {
  test::Random random;
  Watched map(kDecay_s);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  for (int i = 0; i < 90; ++i) {
    Frame frame = half_a_wall(OnTheRight::kThing);
    for (std::uint16_t& d : frame.depth.raw.pixels()) d = random.chance(0.33) ? 0 : d;
    map.show(frame, 0.0334);
  }
  EXPECT_EQ(map.claim(kThingVoxel), Occupancy::kOccupied);
}

TEST(OccupancyDecay, one_frame_after_a_long_silence_clears_nothing) {
  Watched map(kDecay_s);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  map.wait(60.0);
  map.show(half_a_wall(OnTheRight::kNothing), 0.0334);
  EXPECT_EQ(map.claim(kThingVoxel), Occupancy::kOccupied);
}

TEST(OccupancyDecay,
     gives_the_same_bits_on_any_number_of_threads_and_for_both_integrators_the_same_law) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    MapperConfig config;
    config.integrate.threads = threads;
    Watched map(kDecay_s, config);
    map.show(half_a_wall(OnTheRight::kThing), 0.5);
    map.show(half_a_wall(OnTheRight::kNothing), 0.4);
    hashes.push_back(test::bits_of(map.mapper()).hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);

  MapperConfig rays;
  rays.integrate.integrator = "rays";
  Watched map(kDecay_s, rays);
  map.show(half_a_wall(OnTheRight::kThing), 1.0);
  map.show(half_a_wall(OnTheRight::kNothing), 1.1);
  EXPECT_EQ(map.at(kThingVoxel), kUnknownVoxel);
}

}  // namespace
}  // namespace swiftlet
