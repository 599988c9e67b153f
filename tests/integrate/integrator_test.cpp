// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/integrator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/reference_mapper.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/integrate/evidence_sums.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {
namespace {

using test::Random;
using test::ReferenceMapper;

constexpr double kVoxel_m = 0.2;
constexpr double kLogOddsPerStep = 0.04;

RollingMap new_map() {
  auto map = RollingMap::create({.voxel_m = kVoxel_m, .size_m = {8, 8, 8}, .trigger_m = {1, 1, 1}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  return std::move(*map);
}

ReferenceMapper reference_for(const Frame& frame, int ratio) {
  ReferenceMapper reference{};
  reference.width = frame.intrinsics.width();
  reference.height = frame.intrinsics.height();
  reference.fx = frame.intrinsics.fx();
  reference.fy = frame.intrinsics.fy();
  reference.cx = frame.intrinsics.cx();
  reference.cy = frame.intrinsics.cy();
  reference.T_world_camera = Eigen::Matrix4d::Identity();
  reference.T_world_camera.topLeftCorner<3, 3>() =
      frame.T_world_camera.rotation().toRotationMatrix();
  reference.T_world_camera.topRightCorner<3, 1>() = frame.T_world_camera.translation();
  reference.n = ratio;
  return reference;
}

IntegrationTally integrate(RollingMap& map, const Frame& frame, int ratio,
                           const IntegrateOptions& options = {.integrator = "rays"},
                           std::uint64_t frame_number = 0) {
  PreprocessOptions condition;
  condition.downsample = ratio;
  auto preprocessor = Preprocessor::create(condition);
  const PreprocessedDepth& depth = preprocessor->clean(frame.depth, frame.intrinsics, {});
  DepthRangePyramid pyramid;
  pyramid.build(depth.raw);
  const StereoSensor sensor(frame.intrinsics, SensorOptions{}, kVoxel_m, depth.ratio);
  const auto model = find_measurement_model("inverse_sensor_model")->make();
  return (*make_integrator(options))
      ->integrate({depth, pyramid, frame.intrinsics, frame.T_world_camera, frame_number}, sensor,
                  *model, map);
}

// One frame from unknown: every voxel must be the reference's real number, rounded up or down.
TEST(RayIntegrator, gives_every_voxel_the_reference_s_evidence_within_one_rounding) {
  Random random;
  for (const int ratio : {1, 2, 3, 8}) {
    for (int trial = 0; trial < 2; ++trial) {
      const Frame frame = test::random_frame(random, test::small_camera(16, 12));
      RollingMap map = new_map();
      integrate(map, frame, ratio);

      std::vector<double> depth;
      for (const std::uint16_t d : frame.depth.raw.pixels())
        depth.push_back(d * double{frame.depth.unit_m});
      const VoxelBox box = voxel_box(map.window());
      const auto sums = reference_for(frame, ratio)
                            .frame_sums(depth, {box.first.x, box.first.y, box.first.z},
                                        {box.last.x, box.last.y, box.last.z});

      for (int x = box.first.x; x <= box.last.x; ++x) {
        for (int y = box.first.y; y <= box.last.y; ++y) {
          for (int z = box.first.z; z <= box.last.z; ++z) {
            const auto found = sums.find({x, y, z});
            const double expected =
                std::clamp(127.0 + (found == sums.end() ? 0.0 : found->second), 0.0, 255.0);
            // 0.01: fixed point of 2^-20 a ray, a few hundred rays a voxel, and touching voxels
            // either way.
            ASSERT_NEAR(map.log_odds({x, y, z}), expected, 1.01)
                << x << " " << y << " " << z << random.repeat();
          }
        }
      }
    }
  }
}

class EveryIntegrator : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] IntegrateOptions options() const { return {.integrator = GetParam()}; }
};

std::map<BlockIndex, VoxelBlock> blocks_of(const RollingMap& map) {
  std::map<BlockIndex, VoxelBlock> blocks;
  map.for_each_known_block([&](const BlockIndex& i, const VoxelBlock& b) { blocks[i] = b; });
  return blocks;
}

TEST_P(EveryIntegrator, gives_the_same_bits_for_the_same_frames) {
  Random random;
  RollingMap a = new_map(), b = new_map();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const Frame frame = test::random_frame(random, test::small_camera());
    integrate(a, frame, 1, options(), i);
    integrate(b, frame, 1, options(), i);
  }
  EXPECT_EQ(blocks_of(a), blocks_of(b));
}

TEST_P(EveryIntegrator, takes_invalid_pixels_for_no_evidence) {
  Random random;
  Frame frame = test::random_frame(random, test::small_camera());
  std::ranges::fill(frame.depth.raw.pixels(), std::uint16_t{0});
  RollingMap map = new_map();
  EXPECT_EQ(integrate(map, frame, 1, options()).readings, 0U);
  map.for_each_known_block([](const BlockIndex&, const VoxelBlock& block) {
    for (const QuantizedLogOdds voxel : block.voxels) EXPECT_EQ(voxel, kUnknownVoxel);
  });
}

TEST_P(EveryIntegrator, leaves_voxels_behind_the_surface_untouched) {
  RollingMap map = new_map();
  const double wall_m = 2.1;  // the middle of a voxel
  const Frame frame = test::wall_frame(test::small_camera(80, 60), wall_m);
  for (std::uint64_t i = 0; i < 20; ++i) integrate(map, frame, 1, options(), i);
  const StereoSensor sensor(frame.intrinsics, {}, kVoxel_m, 1);
  const double reach_m = wall_m + 3 * sensor.noise().sigma_m(wall_m) + kVoxel_m;
  const VoxelBox box = voxel_box(map.window());
  for (int x = static_cast<int>(reach_m / kVoxel_m) + 1; x <= box.last.x; ++x) {
    for (int y = box.first.y; y <= box.last.y; ++y)
      ASSERT_EQ(map.log_odds({x, y, 0}), kUnknownVoxel);
  }
  EXPECT_EQ(map.log_odds({10, 0, 0}), kOccupiedVoxel);
  EXPECT_EQ(map.log_odds({5, 0, 0}), kFreeVoxel);
}

// DW's promise: a wall square to the camera gives its voxels and the air before them one whole
// observation a frame, at any distance and any n. Seen in perspective, a voxel on the axis is
// crossed by the rays through its front face, so the observation is (z_centre / z_front)^2 of the
// nominal one, give or take one ray along each edge of the face.
TEST_P(EveryIntegrator, gives_one_observation_a_frame_to_covered_voxels_at_any_distance_and_ratio) {
  const double free_steps = std::log(0.3 / 0.7) / 0.04, hit_steps = std::log(0.97 / 0.03) / 0.04;
  const PinholeIntrinsics camera = test::small_camera(480, 360);
  for (const int ratio : {1, 4}) {
    for (const double wall_m : {1.1, 1.9, 3.1}) {
      RollingMap map = new_map();
      integrate(map, test::wall_frame(camera, wall_m), ratio, options());
      const auto expect_observation = [&](int voxel, double steps) {
        const double z_front_m = voxel * kVoxel_m;
        const double rays_across = camera.fx() * kVoxel_m / z_front_m / ratio;
        const double expected = std::min(128.0, std::pow((voxel + 0.5) / voxel, 2) * steps);
        EXPECT_NEAR(map.log_odds({voxel, 0, 0}) - 127, expected,
                    2.0 / rays_across * std::abs(steps) + 1)
            << wall_m << " m, n = " << ratio;
      };
      const int wall = static_cast<int>(wall_m / kVoxel_m);
      expect_observation(wall - 2, free_steps);
      expect_observation(wall, hit_steps);
    }
  }
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const auto& entry : integrators()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Registered, EveryIntegrator, testing::ValuesIn(integrator_names()),
                         [](const auto& param_info) { return param_info.param; });

TEST(EvidenceSums, do_not_depend_on_the_order_of_the_evidence) {
  Random random;
  std::vector<std::pair<VoxelIndex, std::int32_t>> evidence;
  for (int i = 0; i < 5000; ++i) {
    evidence.push_back({{random.integer(-15, 15), random.integer(-15, 15), random.integer(-15, 15)},
                        random.integer(-3000000, 3000000)});
  }
  std::map<BlockIndex, VoxelBlock> first;
  for (int trial = 0; trial < 5; ++trial) {
    RollingMap map = new_map();
    EvidenceSums sums(kLogOddsPerStep);
    sums.begin(map.window());
    for (const auto& [voxel, steps] : evidence) sums.add(voxel, steps);
    sums.apply(7, map);
    if (trial == 0) first = blocks_of(map);
    ASSERT_EQ(blocks_of(map), first) << random.repeat();
    std::ranges::shuffle(evidence, random.engine());
  }
}

// 512 voxels x 400 frames of a fraction: the mean of what is added has a standard error of
// sqrt(f (1 - f) / 204800) <= 0.0011; five of them.
TEST(EvidenceSums, round_without_bias) {
  for (const double fraction : {0.01, 0.25, 0.5, 0.9}) {
    double total = 0.0;
    for (std::uint64_t frame = 0; frame < 400; ++frame) {
      RollingMap map = new_map();
      EvidenceSums sums(kLogOddsPerStep);
      sums.begin(map.window());
      for (int voxel = 0; voxel < kBlockVoxels; ++voxel) {
        sums.add(voxel_at({0, 0, 0}, voxel), static_cast<std::int32_t>(fraction * kOneStep));
      }
      sums.apply(frame, map);
      for (const QuantizedLogOdds voxel : map.find({0, 0, 0})->voxels)
        total += voxel - kUnknownVoxel;
    }
    EXPECT_NEAR(total / (400.0 * kBlockVoxels), fraction, 0.0055);
  }
}

TEST(EvidenceSums, take_a_voxel_that_is_not_free_to_unknown_but_not_on_to_free) {
  auto map = RollingMap::create({}).value();
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  const VoxelIndex not_free{0, 0, 0}, passed{1, 0, 0}, was_free{2, 0, 0};
  const auto start = [&](const VoxelIndex& v, QuantizedLogOdds value) {
    map.writable(block_of(v)).voxels[offset_in_block(v)] = value;
  };
  start(not_free, 200);
  start(passed, 200);
  start(was_free, 50);
  EvidenceSums sums(kLogOddsPerStep);
  for (std::uint64_t frame = 0; frame < 10; ++frame) {
    sums.begin(map.window());
    for (const VoxelIndex& v : {not_free, passed, was_free}) {
      sums.add(v, static_cast<FixedSteps>(-20 * kOneStep));
      sums.add_ends(v, v == passed ? -1.0 : 1.0);
    }
    sums.apply(frame, map);
  }
  EXPECT_EQ(map.log_odds(not_free), kUnknownVoxel);
  EXPECT_EQ(map.log_odds(passed), kFreeVoxel);
  EXPECT_EQ(map.log_odds(was_free), 50) << "what is not free is not raised either";
  sums.begin(map.window());
  sums.add(not_free, static_cast<FixedSteps>(30 * kOneStep));
  sums.add_ends(not_free, 1.0);
  sums.apply(10, map);
  EXPECT_EQ(map.log_odds(not_free), kUnknownVoxel + 30);
}

TEST(EvidenceSums, saturate_instead_of_wrapping) {
  RollingMap map = new_map();
  EvidenceSums sums(kLogOddsPerStep);
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    sums.begin(map.window());
    sums.add({1, 1, 1}, 100 << kStepFractionBits);
    sums.add({2, 1, 1}, -(100 << kStepFractionBits));
    sums.apply(frame, map);
  }
  EXPECT_EQ(map.log_odds({1, 1, 1}), kOccupiedVoxel);
  EXPECT_EQ(map.log_odds({2, 1, 1}), kFreeVoxel);
}

}  // namespace
}  // namespace swiftlet
