// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {
namespace {

/// All that a run shows of itself: the voxels, where the window lies, and what the voxels mean.
struct Outcome {
  std::map<BlockIndex, VoxelBlock> blocks;
  BlockWindow window{};
  VoxelCounts voxels;

  friend bool operator==(const Outcome& a, const Outcome& b) {
    return a.blocks == b.blocks && a.window == b.window && a.voxels.free == b.voxels.free &&
           a.voxels.unknown == b.voxels.unknown && a.voxels.occupied == b.voxels.occupied;
  }
};

/// A slanted wall from 0.25 m to 11 m: every limit of depth cuts something off.
Frame slanted_wall(double x_m) {
  const auto camera = PinholeIntrinsics::from_field_of_view(64, 48, 1.5);
  Frame frame{{}, {Image<std::uint16_t>(64, 48), 0.001F}, *camera, {}};
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      frame.depth.raw.at(u, v) = static_cast<std::uint16_t>(250 + 168 * u + 3 * v);
    }
  }
  const Eigen::Quaterniond forward = forward_looking_camera().rotation();
  frame.T_world_camera = Transform<World, Camera>::trusted(forward, {x_m, 0.03, 0.01});
  return frame;
}

Outcome outcome_of(const MapperConfig& config) {
  Outcome outcome;
  auto mapper = Mapper::create(config);
  EXPECT_TRUE(mapper) << mapper.error().text();
  if (!mapper) return outcome;
  for (const double x_m : {0.0, 0.6, 1.2, 1.8}) mapper->integrate(slanted_wall(x_m));
  outcome.window = mapper->map().window();
  mapper->map().for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    outcome.blocks.emplace(index, block);
    outcome.voxels.add(block, config.occupancy);
  });
  return outcome;
}

// A value that is allowed and different, far enough to matter.
void change(const ConfigField&, double& value) { value *= 0.6; }
void change(const ConfigField&, int& value) { value -= value / 4 + 1; }
void change(const ConfigField&, Eigen::Vector3d& value) { value *= 0.6; }
void change(const ConfigField&, NewWorldRule& value) { value = NewWorldRule::kKeep; }
void change(const ConfigField& field, std::string& value) {
  if (field.key == "integrate.ray_method") value = "line_drawing";
  if (field.key == "integrate.integrator") value = "projective";
  if (field.key == "integrate.model") value = "precision_weighted";
}
void change(const ConfigField&, std::vector<std::string>& value) { value.pop_back(); }

MapperConfig base_config() {
  MapperConfig config;
  config.depth.downsample = 4;
  config.integrate.integrator = "rays";  // reads ray_method; the parameters below are the other's
  config.integrate.model = "inverse_sensor_model";  // reads importance_m and p_max
  config.depth.min_range_m = 0.4;
  config.depth.distortion = {0.05, 0.08, 0.1, 0.1, 0.1};
  config.map.size_m = {16.0, 16.0, 6.0};  // 0.6 of it must lie in fewer blocks and still be allowed
  return config;
}

TEST(MapperConfig, every_parameter_changes_some_output) {
  const Outcome before = outcome_of(base_config());
  ASSERT_GT(before.voxels.occupied, 0U);
  ASSERT_GT(before.voxels.free, 0U);
  std::vector<std::string> keys;
  const MapperConfig defaults;
  visit_config(defaults,
               [&](const ConfigField& field, const auto&) { keys.emplace_back(field.key); });
  for (const std::string& key : keys) {
    if (key == "integrate.threads" || key == "integrate.max_frame_ms") continue;
    if (key.starts_with("quality.")) continue;  // tests/pipeline/frame_gate_test.cpp
    if (key == "integrate.decay_s") continue;   // tests/pipeline/occupancy_decay_test.cpp
    if (key == "map.on_new_world") continue;    // tests/pipeline/new_world_test.cpp
    if (key == "map.lookahead_s") continue;     // tests/pipeline/lookahead_test.cpp
    MapperConfig config = base_config();
    visit_config(config, [&](const ConfigField& field, auto& value) {
      if (field.key == key) change(field, value);
    });
    ASSERT_TRUE(config.faults().empty()) << key << ": " << config.faults().front().text();
    EXPECT_FALSE(outcome_of(config) == before) << key << " changes nothing";
  }
}

TEST(MapperConfig, threads_change_no_output_and_a_deadline_does) {
  MapperConfig config = base_config();
  config.integrate.integrator = "projective";
  const Outcome before = outcome_of(config);
  config.integrate.threads = 3;
  EXPECT_TRUE(outcome_of(config) == before);
  config.integrate.max_frame_ms = 1e-6;
  EXPECT_FALSE(outcome_of(config) == before);
}

TEST(MapperConfig, sharp_fusion_smooths_behind_the_range_gate) {
  MapperConfig config;
  config.integrate.model = "precision_weighted";
  EXPECT_EQ(config.preprocessing().steps,
            (std::vector<std::string>{"distortion", "range_gate", "smooth", "near_downsample"}));
  config.integrate.model = "blunt";
  ASSERT_EQ(config.faults().size(), 1U);
  EXPECT_EQ(config.faults().front().where, "integrate.model");
}

TEST(MapperConfig, numbers_of_distortion_that_no_step_reads_are_a_fault) {
  MapperConfig config;
  config.depth.steps = {"range_gate"};
  EXPECT_TRUE(config.faults().empty());
  config.depth.distortion.x2_per_m = 0.05;
  ASSERT_EQ(config.faults().size(), 1U);
  EXPECT_EQ(config.faults().front().where, "depth.steps");
}

TEST(MapperConfig, an_integrator_is_chosen_by_its_name) {
  MapperConfig config;
  config.integrate.integrator = "magic";
  ASSERT_EQ(config.faults().size(), 1U);
  EXPECT_EQ(config.faults().front().where, "integrate.integrator");
}

}  // namespace
}  // namespace swiftlet
