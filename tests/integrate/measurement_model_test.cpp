// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The laws of every registered measurement model: a line in the table brings a model in here.

#include <gtest/gtest.h>

#include <cmath>

#include "support/agreement.hpp"
#include "support/every_instruction_set.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {
namespace {

using test::Random;

class EveryMeasurementModel : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static MeasurementModelPtr new_model() {
    return find_measurement_model(GetParam())->make();
  }
};

/// All blocks after a few frames of random relief.
std::vector<VoxelBlock> model_blocks(MeasurementModel& model, std::uint64_t seed, int threads = 1) {
  Random random(seed);
  auto map =
      RollingMap::create({.voxel_m = 0.1, .size_m = {8, 8, 8}, .trigger_m = {1e3, 1e3, 1e3}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  const auto integrator = *make_integrator({.integrator = "projective", .threads = threads});
  auto preprocessor =
      Preprocessor::create({.steps = {"range_gate", "smooth", "near_downsample"}, .downsample = 1});
  DepthRangePyramid pyramid;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const Frame frame = test::random_frame(random, test::small_camera(163, 121));
    const PreprocessedDepth& depth = preprocessor->clean(frame.depth, frame.intrinsics, 0.004);
    const StereoSensor sensor(frame.intrinsics, {}, map->voxel_m(), 1);
    pyramid.build(depth.raw);
    integrator->integrate({depth, pyramid, frame.intrinsics, frame.T_world_camera, i}, sensor,
                          model, *map);
  }
  std::vector<VoxelBlock> blocks;
  map->for_each_known_block(
      [&](const BlockIndex&, const VoxelBlock& block) { blocks.push_back(block); });
  return blocks;
}

TEST_P(EveryMeasurementModel, gives_the_same_bits_on_every_instruction_set_of_this_machine) {
  const std::vector<VoxelBlock> widest = model_blocks(*new_model(), 3);
  ASSERT_GT(widest.size(), 50U);
  const int targets = test::on_every_instruction_set(
      [&](const char* name) { EXPECT_TRUE(model_blocks(*new_model(), 3) == widest) << name; });
  EXPECT_GE(targets, 1);
}

TEST_P(EveryMeasurementModel, gives_the_same_bits_on_any_number_of_threads) {
  const std::vector<VoxelBlock> alone = model_blocks(*new_model(), 5);
  for (const int threads : {2, 3, 4})
    EXPECT_TRUE(model_blocks(*new_model(), 5, threads) == alone) << threads;
}

/// Waves of half a metre and missing pixels: single ones and a patch.
Frame waves(Random& random) {
  const auto T_world_camera =
      Transform<World, Camera>::trusted(random.rotation(), random.vector(-0.5, 0.5));
  Frame frame = test::wall_frame(test::small_camera(320, 240), 1.0, T_world_camera);
  auto& raw = frame.depth.raw;
  const double base_m = random.real(1.5, 3.0), wave = random.real(0.02, 0.05);
  for (int v = 0; v < raw.height(); ++v) {
    for (int u = 0; u < raw.width(); ++u) {
      const bool is_missing =
          (std::abs(u - 250) < 20 && std::abs(v - 60) < 15) || random.chance(0.05);
      const double z_m = base_m + 0.25 * (std::sin(wave * u) + std::cos(wave * v));
      const double read_m = z_m + random.gaussian(0.005 * z_m * z_m);
      raw.at(u, v) = static_cast<std::uint16_t>(is_missing ? 0 : std::lround(1000.0 * read_m));
    }
  }
  return frame;
}

// One free observation takes a voxel just below the threshold, and a voxel that is seen once has
// one: so the class is not asked for where it hangs on a step.
TEST_P(EveryMeasurementModel, says_the_same_from_the_side_of_the_rays_and_of_the_voxels) {
  Random random;
  test::AgreementCheck check(0.1, {9, 9, 9}, Eigen::Vector3d::Zero(), 10.0, 0.05, GetParam());
  for (int i = 0; i < 3; ++i) check.add(waves(random));
  const test::Agreement agreement = check.result();
  SCOPED_TRACE(random.repeat());
  SCOPED_TRACE(agreement.text());
  EXPECT_GT(agreement.voxels, 1000U);
  EXPECT_GE(agreement.clear_class_share(), 0.98);
  EXPECT_LE(agreement.mean_difference(), 3.0);
}

// A wall just behind the face of a voxel, so that the voxel is more than half full.
TEST_P(EveryMeasurementModel, clears_the_air_fills_the_wall_and_leaves_what_is_behind_it) {
  constexpr double kWall_m = 2.02, kEdge_m = 0.2;
  const Frame frame = test::wall_frame(test::small_camera(80, 60), kWall_m);
  for (const auto& integrator : integrators()) {
    SCOPED_TRACE(integrator.name);
    auto map = RollingMap::create({.voxel_m = kEdge_m, .size_m = {8, 8, 8}});
    map->recentre(Eigen::Vector3d::Zero(), nullptr);
    const auto fuses = *make_integrator({.integrator = std::string(integrator.name)});
    auto preprocessor = Preprocessor::create({.downsample = 1});
    const PreprocessedDepth& depth = preprocessor->clean(frame.depth, frame.intrinsics, 0.004);
    DepthRangePyramid pyramid;
    pyramid.build(depth.raw);
    const StereoSensor sensor(frame.intrinsics, {}, kEdge_m, 1);
    const MeasurementModelPtr model = new_model();
    for (std::uint64_t i = 0; i < 20; ++i) {
      fuses->integrate({depth, pyramid, frame.intrinsics, frame.T_world_camera, i}, sensor, *model,
                       *map);
    }
    const double reach_m = model->ray_end_m(kWall_m) + kEdge_m;
    const VoxelBox box = voxel_box(map->window());
    for (int x = static_cast<int>(reach_m / kEdge_m) + 1; x <= box.last.x; ++x) {
      for (int y = box.first.y; y <= box.last.y; ++y)
        ASSERT_EQ(map->log_odds({x, y, 0}), kUnknownVoxel) << x << " " << y;
    }
    EXPECT_EQ(map->log_odds({10, 0, 0}), kOccupiedVoxel);
    EXPECT_EQ(map->log_odds({5, 0, 0}), kFreeVoxel);
  }
}

TEST(MeasurementModels, are_known_by_name_and_an_unknown_name_is_told_which_there_are) {
  EXPECT_GE(measurement_models().size(), 3U);
  for (const auto& entry : measurement_models()) {
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
    EXPECT_TRUE(find_measurement_model(entry.name)) << entry.name;
  }
  const auto none = find_measurement_model("blunt");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().text().find("precision_weighted"), std::string::npos);
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& entry : measurement_models()) names.emplace_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Registered, EveryMeasurementModel, testing::ValuesIn(model_names()),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace swiftlet
