// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/render/projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <ostream>

#include "support/seeds.hpp"
#include "swiftlet/render/coarser_map.hpp"

namespace swiftlet::render {
namespace {

void set(BlockMap& map, const VoxelIndex& v, QuantizedLogOdds value) { map.set(v, value); }

/// The same blocks under another header.
BlockMap with_header(const BlockMap& map, double voxel_m, const Eigen::Vector3d& start_m) {
  BlockMap other = map;
  other.set_header({voxel_m, map.scale(), 0, start_m});
  return other;
}

/// A floor of 12 x 8 voxels, free above, one pillar of three voxels at (3, 2).
BlockMap pillar() {
  BlockMap map;
  for (std::int32_t x = -2; x < 10; ++x) {
    for (std::int32_t y = -4; y < 4; ++y) {
      set(map, {x, y, 0}, kOccupiedVoxel);
      for (std::int32_t z = 1; z < 5; ++z) set(map, {x, y, z}, kFreeVoxel);
    }
  }
  for (std::int32_t z = 1; z < 4; ++z) set(map, {3, 2, z}, kOccupiedVoxel);
  return map;
}

std::size_t pixels_of(const render::Picture& picture, render::Colour colour) {
  return static_cast<std::size_t>(std::ranges::count(picture.pixels(), colour));
}

class EveryProjection : public ::testing::TestWithParam<Registered<DrawProjection>> {};

TEST_P(EveryProjection, shows_a_change_of_the_map) {
  const BlockMap with = pillar();
  BlockMap without = with;
  for (std::int32_t z = 1; z < 4; ++z) set(without, {3, 2, z}, kFreeVoxel);
  const ProjectionOptions options{0.3, 4};  // z = 0.3 m: layer 1
  const auto a = draw_projection(GetParam().name, with, options);
  const auto b = draw_projection(GetParam().name, without, options);
  ASSERT_TRUE(a && b);
  EXPECT_FALSE(std::ranges::equal(a->pixels(), b->pixels()));
}

TEST_P(EveryProjection, draws_the_same_map_the_same_way_whatever_the_order_of_its_blocks) {
  const BlockMap map = pillar();
  BlockMap reordered(map.header());
  auto order = map.sorted_blocks();
  std::ranges::reverse(order);
  for (const BlockIndex& index : order) reordered.put(index, *map.find(index));
  const auto a = draw_projection(GetParam().name, map, {});
  const auto b = draw_projection(GetParam().name, reordered, {});
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(std::ranges::equal(a->pixels(), b->pixels()));
}

TEST_P(EveryProjection, refuses_a_map_of_unknown_voxels_and_a_picture_without_end) {
  EXPECT_EQ(draw_projection(GetParam().name, BlockMap{}, {}).error().code, ErrorCode::kNotFound);
  BlockMap wide;
  set(wide, {-2'000'000'000, 0, 0}, kOccupiedVoxel);
  set(wide, {2'000'000'000, 0, 0}, kOccupiedVoxel);
  EXPECT_EQ(draw_projection(GetParam().name, wide, {}).error().code, ErrorCode::kUsage);
}

TEST_P(EveryProjection, draws_two_blocks_a_kilometre_apart_small_and_soon) {
  BlockMap map;
  set(map, {0, 0, 0}, kOccupiedVoxel);
  set(map, {5000, 5000, 5000}, kOccupiedVoxel);
  const auto start = std::chrono::steady_clock::now();
  const auto picture = draw_projection(GetParam().name, map, {});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  ASSERT_TRUE(picture) << picture.error().text();
  EXPECT_LT(picture->pixels().size(), 12'000'000U);
  EXPECT_GT(joined_voxels(map, {}), 1) << "and this is told";
  EXPECT_EQ(joined_voxels(pillar(), {}), 1);
}

TEST_P(EveryProjection, draws_voxels_of_any_size_and_a_start_that_is_nowhere) {
  for (const double voxel_m : {1e300, 1e-300}) {
    const BlockMap map =
        with_header(pillar(), voxel_m, {1e300, std::numeric_limits<double>::quiet_NaN(), -1e300});
    EXPECT_TRUE(draw_projection(GetParam().name, map, {})) << voxel_m;
    EXPECT_TRUE(
        draw_projection(GetParam().name, map, {std::numeric_limits<double>::quiet_NaN(), 4}));
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryProjection,
                         ::testing::ValuesIn(render::projections().begin(),
                                             render::projections().end()),
                         [](const auto& projection) { return std::string(projection.param.name); });

TEST(SliceProjection, has_as_many_pixels_of_each_colour_as_the_layer_has_voxels) {
  const int px = 32;  // ticks, scale bar and origin stay within the margin and one voxel
  const auto picture = draw_projection("slice", pillar(), {0.3, px});
  ASSERT_TRUE(picture);
  const std::size_t voxel = px * px;
  EXPECT_EQ(pixels_of(*picture, {31, 73, 160}), voxel) << "the pillar";
  const std::size_t free = pixels_of(*picture, {255, 226, 89});
  EXPECT_LE(free, 95 * voxel);
  EXPECT_GT(free, 94 * voxel) << "the origin's cross covers part of four voxels";
}

TEST(SliceProjection, shows_the_layer_where_the_flight_began_unless_told_otherwise) {
  const BlockMap map = with_header(pillar(), 0.2, {0.1, 0.1, 0.7});  // layer 3
  const auto asked = draw_projection("slice", map, {0.7, 8});
  const auto unasked = draw_projection("slice", map, {std::nullopt, 8});
  const auto floor = draw_projection("slice", map, {0.1, 8});
  ASSERT_TRUE(asked && unasked && floor);
  EXPECT_TRUE(std::ranges::equal(asked->pixels(), unasked->pixels()));
  EXPECT_FALSE(std::ranges::equal(floor->pixels(), unasked->pixels()));
}

TEST(SliceProjection, x_forward_is_up_and_y_left_is_left) {
  const auto picture = draw_projection("slice", pillar(), {0.3, 8});
  ASSERT_TRUE(picture);
  // Rows of voxels from x = 9 down to -2, columns from y = 3 to -4, behind the margin of 28 px.
  EXPECT_EQ(picture->at(28 + (3 - 2) * 8 + 4, 28 + (9 - 3) * 8 + 4), (render::Colour{31, 73, 160}));
}

TEST(Polygon, covers_the_area_of_a_random_rectangle_once) {
  test::for_each_seed(100, [](test::Random& random) {
    const auto x0 = random.integer(0, 20), y0 = random.integer(0, 20);
    const auto x1 = random.integer(x0, 30), y1 = random.integer(y0, 30);
    render::Picture by_polygon(32, 32);
    render::Picture by_rectangle(32, 32);
    const std::array corners{Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y0),
                             Eigen::Vector2d(x1, y1), Eigen::Vector2d(x0, y1)};
    fill_polygon(by_polygon, corners, {1, 2, 3});
    fill_rectangle(by_rectangle, x0, y0, x1, y1, {1, 2, 3});
    EXPECT_TRUE(std::ranges::equal(by_polygon.pixels(), by_rectangle.pixels()));
  });
}

TEST(Polygon, two_that_share_an_edge_leave_no_gap_and_do_not_overlap) {
  test::for_each_seed(100, [](test::Random& random) {
    const auto corner = [&] { return Eigen::Vector2d(random.real(-5, 35), random.real(-5, 35)); };
    const Eigen::Vector2d a(-100, -100), b(200, -100), c(-100, 200), d(200, 200);
    const Eigen::Vector2d top(random.real(0, 30), -100), low(corner().x(), 200);
    render::Picture left(32, 32), right(32, 32);
    fill_polygon(left, std::array{a, top, low, c}, {0, 0, 0});
    fill_polygon(right, std::array{top, b, d, low}, {0, 0, 0});
    EXPECT_EQ(pixels_of(left, {0, 0, 0}) + pixels_of(right, {0, 0, 0}), 32U * 32U);
  });
}

TEST(CoarserMap, keeps_matter_before_emptiness_on_both_sides_of_the_origin) {
  BlockMap map;
  set(map, {-1, -3, 2}, kOccupiedVoxel);
  for (std::int32_t x = -3; x < 3; ++x) set(map, {x, 0, 0}, kFreeVoxel);
  const BlockMap large = coarser_map(map, 3);
  EXPECT_DOUBLE_EQ(large.voxel_m(), 3 * map.voxel_m());
  EXPECT_EQ(large.occupancy(VoxelIndex{-1, -1, 0}), Occupancy::kOccupied);
  EXPECT_EQ(large.occupancy(VoxelIndex{-1, 0, 0}), Occupancy::kFree);
  EXPECT_EQ(large.occupancy(VoxelIndex{0, 0, 0}), Occupancy::kFree);
  EXPECT_EQ(large.occupancy(VoxelIndex{0, -1, 0}), Occupancy::kUnknown);
}

TEST(HeightColour, runs_from_dark_to_bright) {
  const auto grey = [](render::Colour c) { return 0.3 * c.r + 0.59 * c.g + 0.11 * c.b; };
  for (int i = 1; i <= 100; ++i) {
    EXPECT_GE(grey(height_colour(i / 100.0)), grey(height_colour((i - 1) / 100.0)) - 1.0) << i;
  }
  EXPECT_EQ(height_colour(-1.0), height_colour(0.0));
  EXPECT_EQ(height_colour(2.0), height_colour(1.0));
}

}  // namespace
}  // namespace swiftlet::render
