// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/upkeep/thin_obstacle_filter.hpp"

#include <gtest/gtest.h>

#include "support/synthetic.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet {
namespace {

/// A wall 3 m ahead and, if it is wanted, a rod of two pixels 1 m ahead of a camera at the origin:
/// the rod covers a twenty-fourth of a voxel of 0.2 m, f being 200 px.
Frame rod_before_wall(bool has_rod) {
  const auto camera = PinholeIntrinsics::create(400, 100, 200, 200, 199.5, 49.5).value();
  Frame frame = test::wall_frame(camera, 3.0);
  for (int v = 0; v < 100 && has_rod; ++v) {
    for (const int u : {219, 220}) frame.depth.raw.at(u, v) = 1000;
  }
  return frame;
}

// u = 219.5 is 0.1 m to the right at 1 m: in the voxel [-0.2, 0) along y.
const VoxelIndex kRodVoxel{5, -1, 0};
const VoxelIndex kBeside{5, 0, 0};

Mapper mapper_with(const char* model) {
  MapperConfig config;
  config.integrate.model = model;
  return Mapper::create(config).value();
}

Occupancy claim(const Mapper& mapper, const VoxelIndex& v) {
  return mapper.config().occupancy.classify(mapper.map().log_odds(v));
}

TEST(ThinObstacleFilter, keep_a_rod_that_the_mean_of_all_rays_erases) {
  Mapper plain = mapper_with("inverse_sensor_model"),
         preserving = mapper_with("thin_obstacle_preserving"),
         weighted = mapper_with("precision_weighted");
  for (int i = 0; i < 20; ++i) {
    for (Mapper* mapper : {&plain, &preserving, &weighted})
      mapper->integrate(rod_before_wall(true));
  }
  EXPECT_EQ(claim(plain, kRodVoxel), Occupancy::kFree);
  for (const Mapper* mapper : {&preserving, &weighted}) {
    EXPECT_EQ(claim(*mapper, kRodVoxel), Occupancy::kOccupied);
    EXPECT_EQ(claim(*mapper, kBeside), Occupancy::kFree);
  }
}

TEST(ThinObstacleFilter, notice_a_rod_in_space_that_was_surely_free_within_five_frames) {
  Mapper weighted = mapper_with("precision_weighted");
  for (int i = 0; i < 20; ++i) weighted.integrate(rod_before_wall(false));
  ASSERT_EQ(claim(weighted, kRodVoxel), Occupancy::kFree);
  // From 0 to 180 in steps of kGain.
  for (int i = 0; i < 5; ++i) weighted.integrate(rod_before_wall(true));
  EXPECT_EQ(claim(weighted, kRodVoxel), Occupancy::kOccupied);
}

TEST(ThinObstacleFilter, let_go_of_a_rod_that_has_gone) {
  Mapper weighted = mapper_with("precision_weighted");
  for (int i = 0; i < 20; ++i) weighted.integrate(rod_before_wall(true));
  for (int i = 0; i < 10; ++i) weighted.integrate(rod_before_wall(false));
  EXPECT_EQ(claim(weighted, kRodVoxel), Occupancy::kFree);
}

TEST(ThinObstacleFilter, find_nothing_thin_in_a_wall_nor_at_the_edge_of_something_wide) {
  Frame frame = rod_before_wall(false);
  for (int v = 0; v < 100; ++v) {
    for (int u = 230; u < 400; ++u) frame.depth.raw.at(u, v) = 1000;
  }
  auto map = RollingMap::create({}).value();
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  PreprocessedDepth depth;
  depth.raw = frame.depth.raw;
  DepthRangePyramid pyramid;
  pyramid.build(depth.raw);
  ThinObstacleFilter hits;
  hits.collect({depth, pyramid, frame.intrinsics, frame.T_world_camera, 0}, map);
  EXPECT_EQ(hits.protect(map), 0U);
}

TEST(ThinObstacleFilter, never_make_more_of_the_map_than_it_holds) {
  // Noise: everything looks thin. No more voxels are kept than there is room for, none outside.
  test::Random random;
  const auto camera = PinholeIntrinsics::create(400, 300, 200, 200, 199.5, 149.5).value();
  auto map = RollingMap::create({.voxel_m = 0.02, .size_m = {4, 4, 4}}).value();
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  ThinObstacleFilter hits;
  DepthRangePyramid pyramid;
  for (int i = 0; i < 5; ++i) {
    Frame frame = test::wall_frame(camera, 1.0);
    for (std::uint16_t& d : frame.depth.raw.pixels())
      d = static_cast<std::uint16_t>(random.integer(0, 9000));
    PreprocessedDepth depth;
    depth.raw = frame.depth.raw;
    pyramid.build(depth.raw);
    hits.collect({depth, pyramid, frame.intrinsics, frame.T_world_camera, 0}, map);
    const std::size_t raised = hits.protect(map);
    EXPECT_GT(raised, 0U);
    EXPECT_LE(raised, ThinObstacleFilter::kMostVoxels);
  }
}

}  // namespace
}  // namespace swiftlet
