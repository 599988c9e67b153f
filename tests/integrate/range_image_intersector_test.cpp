// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The intersector decides which voxels need no look. It must be conservative: never free or
// unobserved where ray tracing finds more in a single one of their voxels.

#include "swiftlet/integrate/projective/range_image_intersector.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/every_instruction_set.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {
namespace {

using test::Random;

constexpr double kLawVoxel_m = 0.1, kLawSteps = 0.04;
/// Half the edge of the box of blocks that is asked, and what is asked at once.
constexpr std::int32_t kHalfBlocks = 4;

/// Waves and, at times, a box before them. Of three frames one has all its readings, one lacks a
/// few and one has but a few, so that a single reading that says something is not outvoted by
/// others.
Frame scattered_frame(Random& random, int kind) {
  Frame frame = test::random_frame(random, test::small_camera(160, 120));
  auto& raw = frame.depth.raw;
  const double base_m = random.real(kind == 0 ? 2.0 : 0.8, 3.0), wave = random.real(0.02, 0.2);
  const double missing = kind == 0 ? 0.0 : kind == 1 ? 0.02 : random.real(0.5, 0.99);
  const bool has_box = random.chance(0.7);
  for (int v = 0; v < raw.height(); ++v) {
    for (int u = 0; u < raw.width(); ++u) {
      const bool is_box = has_box && std::abs(u - 60) < 15 && std::abs(v - 50) < 20;
      const double z_m = base_m * (is_box ? 0.6 : 1.0) + 0.2 * std::sin(wave * (u + v));
      raw.at(u, v) =
          static_cast<std::uint16_t>(random.chance(missing) ? 0 : std::lround(1000.0 * z_m));
    }
  }
  return frame;
}

/// A frame, and what ray tracing makes of it in an empty map.
struct TracedFrame {
  TracedFrame(Random& random, int kind, std::string_view model_name)
      : frame(scattered_frame(random, kind)),
        preprocessor(*Preprocessor::create({.downsample = 1})),
        depth(preprocessor.clean(frame.depth, frame.intrinsics, 0.004)),
        sensor(frame.intrinsics, {}, kLawVoxel_m, 1),
        map(*RollingMap::create({.voxel_m = kLawVoxel_m, .size_m = {8, 8, 8}})),
        model(find_measurement_model(model_name)->make()) {
    map.recentre(Eigen::Vector3d::Zero(), nullptr);
    pyramid.build(depth.raw);
    (*make_integrator({.integrator = "rays"}))->integrate(view(), sensor, *model, map);
  }

  [[nodiscard]] DepthView view() const {
    return {depth, pyramid, frame.intrinsics, frame.T_world_camera, 0};
  }
  [[nodiscard]] KernelParams params(const CubeView& cubes) const {
    const float farthest_m = depth.unit_m * static_cast<float>(pyramid.farthest());
    return kernel_params(view_params(cubes, depth.unit_m), model->prepare(cubes, farthest_m),
                         sensor, kLawSteps);
  }

  Frame frame;
  Preprocessor preprocessor;
  const PreprocessedDepth& depth;
  DepthRangePyramid pyramid;
  StereoSensor sensor;
  RollingMap map;
  MeasurementModelPtr model;
};

/// Counts how often each type was told, so that no law holds for want of cases.
using TypeCounts = std::array<int, 4>;

void expect_conservative(const TracedFrame& traced, const VoxelIndex& first, int edge,
                         UpdateType type) {
  if (type == UpdateType::kPossiblyOccupied) return;
  for (int i = 0; i < edge * edge * edge; ++i) {
    const VoxelIndex voxel{first.x + i % edge, first.y + i / edge % edge,
                           first.z + i / edge / edge};
    const int value = traced.map.log_odds(voxel);
    if (type == UpdateType::kUnobserved) {
      ASSERT_EQ(value, kUnknownVoxel) << "hidden, but rays say something";
    } else {
      ASSERT_LE(value, kUnknownVoxel) << "free, but rays say there is matter";
    }
  }
}

TypeCounts check_all_cubes(const TracedFrame& traced, int edge) {
  const DepthView view = traced.view();
  const CubeView cubes(view, kLawVoxel_m);
  const KernelParams params = traced.params(cubes);
  TypeCounts counts{};
  const std::int32_t end = kHalfBlocks * kBlockEdge;
  for (std::int32_t z = -end; z < end; z += edge) {
    for (std::int32_t y = -end; y < end; y += edge) {
      for (std::int32_t x = -end; x < end;) {
        CubeBatch batch;
        const std::int32_t first_x = x;
        for (; x < end && batch.count < CubeBatch::kMost; x += edge) {
          const CubeInView cube = cubes.cube({x, y, z}, edge);
          batch.half_camera = cube.half_camera;
          batch.add(cube.p_camera);
        }
        UpdateTypes types;
        intersect_cubes(params, traced.pyramid.tiles(), batch, types);
        for (std::size_t i = 0; i < batch.count; ++i) {
          const VoxelIndex first{first_x + static_cast<std::int32_t>(i) * edge, y, z};
          expect_conservative(traced, first, edge, types[i]);
          ++counts[static_cast<std::size_t>(types[i])];
        }
      }
    }
  }
  return counts;
}

class ConservativeIntersector : public testing::TestWithParam<std::string> {};

TEST_P(ConservativeIntersector, never_says_free_or_unobserved_where_a_single_voxel_is_not) {
  TypeCounts all{};
  Random random;
  SCOPED_TRACE(random.repeat());
  for (int trial = 0; trial < 9 && !HasFatalFailure(); ++trial) {
    const TracedFrame traced(random, trial % 3, GetParam());
    for (const int edge : {2, 4, 8, 16}) {
      const TypeCounts counts = check_all_cubes(traced, edge);
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += counts[i];
    }
  }
  for (const int count : all) EXPECT_GT(count, 20) << "a type that never came up was not checked";
}

// Where all of an image is a wall far behind, the cubes in its middle are plainly free; beyond the
// wall and behind the camera they are unobserved: being conservative is no excuse for "perhaps".
TEST_P(ConservativeIntersector, is_sure_where_there_is_no_doubt) {
  Random random;
  TracedFrame traced(random, 0, GetParam());
  traced.frame = test::wall_frame(test::small_camera(160, 120), 3.0);
  static_cast<void>(traced.preprocessor.clean(traced.frame.depth, traced.frame.intrinsics, 0.004));
  traced.pyramid.build(traced.depth.raw);
  const DepthView view = traced.view();
  const CubeView cubes(view, kLawVoxel_m);
  const KernelParams params = traced.params(cubes);
  const auto type_at = [&](const VoxelIndex& first) {
    CubeBatch batch;
    const CubeInView cube = cubes.cube(first, 4);
    batch.half_camera = cube.half_camera;
    batch.add(cube.p_camera);
    UpdateTypes types;
    intersect_cubes(params, traced.pyramid.tiles(), batch, types);
    return types[0];
  };
  EXPECT_EQ(type_at({12, -2, -2}), UpdateType::kFree);
  EXPECT_EQ(type_at({28, -2, -2}), UpdateType::kPossiblyOccupied) << "the wall";
  EXPECT_EQ(type_at({40, -2, -2}), UpdateType::kUnobserved) << "behind the wall";
  EXPECT_EQ(type_at({-20, -2, -2}), UpdateType::kUnobserved) << "behind the camera";
}

std::vector<std::string> conservative_models() {
  std::vector<std::string> names;
  for (const auto& entry : measurement_models()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Registered, ConservativeIntersector,
                         testing::ValuesIn(conservative_models()),
                         [](const auto& param_info) { return param_info.param; });

// The pixel that the middle of a cube falls on is one of those that it covers.
TEST(ImageRanges, hold_the_reading_at_the_middle_of_a_cube_on_every_instruction_set) {
  Random random;
  SCOPED_TRACE(random.repeat());
  const TracedFrame traced(random, 1, "inverse_sensor_model");
  const DepthView view = traced.view();
  const CubeView cubes(view, kLawVoxel_m);
  const ViewParams params = view_params(cubes, traced.depth.unit_m);
  const auto& raw = traced.depth.raw;
  const auto check = [&](const char* name) {
    int in_view = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const VoxelIndex voxel{random.integer(-25, 25), random.integer(-25, 25),
                             random.integer(-25, 25)};
      const CubeInView cube = cubes.cube(voxel, 1);
      if (cube.z_near() < 0.5F * params.voxel_m) continue;
      const float u = params.fx * cube.p_camera[0] / cube.p_camera[2] + params.u_offset;
      const float v = params.fy * cube.p_camera[1] / cube.p_camera[2] + params.v_offset;
      if (u < 1.0F || v < 1.0F || u > params.width - 1.0F || v > params.height - 1.0F) continue;
      CubeBatch batch;
      batch.half_camera = cube.half_camera;
      batch.add(cube.p_camera);
      for (const int finer : {0, 1}) {
        ImageRanges ranges;
        find_image_ranges(params, traced.pyramid.tiles(), finer, batch, ranges);
        const int reading = raw.at(static_cast<int>(u), static_cast<int>(v));
        EXPECT_TRUE(ranges.is_in_view[0]) << name;
        EXPECT_TRUE(reading != 0 || ranges.has_gaps[0]) << name;
        EXPECT_TRUE(reading == 0 || ranges.nearest[0] <= reading) << name;
        EXPECT_GE(ranges.farthest[0], reading) << name;
      }
      ++in_view;
    }
    EXPECT_GT(in_view, 10) << name;
  };
  EXPECT_GE(test::on_every_instruction_set(check), 1);
}

}  // namespace
}  // namespace swiftlet
