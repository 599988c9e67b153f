// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/mapper.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "support/allocations.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/query/occupancy_query.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {
namespace {

using test::Random;

Mapper new_mapper(const MapperConfig& config = {}) {
  auto mapper = Mapper::create(config);
  EXPECT_TRUE(mapper) << mapper.error().text();
  return std::move(*mapper);
}

Transform<World, Camera> looking_forward_from(const Eigen::Vector3d& p_world) {
  return Transform<World, Body>::trusted(Eigen::Quaterniond::Identity(), p_world) *
         forward_looking_camera();
}

TEST(Mapper, turns_frames_of_a_wall_into_free_air_and_an_occupied_wall) {
  MapperConfig config;
  config.depth.downsample = 1;
  Mapper mapper = new_mapper(config);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(mapper.integrate(test::wall_frame(test::small_camera(80, 60), 3.02)).verdict,
              FrameVerdict::kIntegrated);
  }
  const auto snapshot = mapper.snapshot();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->frame_count(), 5U);
  EXPECT_EQ(occupancy_at(*snapshot, {1.5, 0.1, 0.1}, config.occupancy), Occupancy::kFree);
  EXPECT_EQ(occupancy_at(*snapshot, {3.1, 0.1, 0.1}, config.occupancy), Occupancy::kOccupied);
  EXPECT_EQ(occupancy_at(*snapshot, {4.0, 0.1, 0.1}, config.occupancy), Occupancy::kUnknown);
  EXPECT_EQ(occupancy_at(*snapshot, {-1.0, 0.1, 0.1}, config.occupancy), Occupancy::kUnknown);
}

TEST(Mapper, hands_out_snapshots_that_tell_their_frame_and_how_they_are_read) {
  MapperConfig config;
  config.occupancy = {90, 200};
  config.integrate.logodds_per_step = 0.05;
  Mapper mapper = new_mapper(config);
  Frame frame = test::wall_frame(test::small_camera(80, 60), 3.02);
  frame.stamp = {1'234'567};
  ASSERT_EQ(mapper.integrate(frame).verdict, FrameVerdict::kIntegrated);
  Frame bad = frame;
  bad.stamp = {2'000'000};
  bad.depth.raw.resize(0, 0);
  ASSERT_NE(mapper.integrate(bad).verdict, FrameVerdict::kIntegrated);
  const auto snapshot = mapper.snapshot();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->stamp(), frame.stamp) << "of the newest frame that is in the map";
  EXPECT_EQ(snapshot->T_world_camera().translation(), frame.T_world_camera.translation());
  EXPECT_EQ(snapshot->scale(), (LogOddsScale{{90, 200}, 0.05}));
  mapper.begin_world(1);
  EXPECT_EQ(mapper.snapshot()->frame_count(), 0U);
}

// Half a voxel of matter may be unknown; the next one is all matter.
TEST(Mapper, lets_nobody_through_a_wall_wherever_it_stands_in_its_voxel) {
  MapperConfig config;
  for (int wall_mm = 3000; wall_mm <= 3200; wall_mm += 10) {
    Mapper mapper = new_mapper(config);
    const double x_m = 0.001 * wall_mm;
    for (int i = 0; i < 10; ++i)
      mapper.integrate(test::wall_frame(test::small_camera(80, 60), x_m));
    const auto occupancy = [&](double at_m) {
      return config.occupancy.classify(
          mapper.map().log_odds(voxel_containing({at_m, 0.1, 0.1}, mapper.map().voxel_m())));
    };
    EXPECT_NE(occupancy(x_m + 0.01), Occupancy::kFree) << wall_mm;
    EXPECT_TRUE(occupancy(x_m + 0.01) == Occupancy::kOccupied ||
                occupancy(x_m + 0.15) == Occupancy::kOccupied)
        << wall_mm;
    EXPECT_EQ(occupancy(x_m - 0.3), Occupancy::kFree) << wall_mm;
  }
}

TEST(Mapper, refuses_frames_it_cannot_use_and_leaves_the_map_alone) {
  Mapper mapper = new_mapper();
  Frame empty = test::wall_frame(test::small_camera(), 0.0);
  EXPECT_EQ(mapper.integrate(empty).verdict, FrameVerdict::kNoReadings);
  EXPECT_EQ(mapper.integrate(test::wall_frame(test::small_camera(), 65.535)).verdict,
            FrameVerdict::kSaturated);
  EXPECT_EQ(mapper.integrate(test::wall_frame(test::small_camera(), 15.0)).verdict,
            FrameVerdict::kNoReadings)
      << "beyond max_range_m";

  Frame wrong_size = test::wall_frame(test::small_camera(), 1.0);
  wrong_size.depth.raw.resize(20, 20, 1000);
  EXPECT_EQ(mapper.integrate(wrong_size).verdict, FrameVerdict::kSizeMismatch);
  EXPECT_EQ(
      mapper
          .integrate(test::wall_frame(test::small_camera(), 1.0, looking_forward_from({2e6, 0, 0})))
          .verdict,
      FrameVerdict::kPoseOutOfRange);
  EXPECT_EQ(mapper.frame_count(), 0U);
  EXPECT_EQ(count_voxels(*mapper.snapshot()).free, 0U);
}

// Warm-up: two tours of what is to come, over an empty map and over a full one, so that every
// buffer has met its largest frame.
TEST(Mapper, allocates_nothing_after_warm_up_even_when_the_window_moves_and_readers_follow) {
  Random random;
  const auto expect_none = [&](std::string_view integrator, std::string_view model) {
    MapperConfig config;
    config.depth.downsample = 2;
    config.map.size_m = {6, 6, 4};
    config.integrate.integrator = integrator;
    config.integrate.model = model;
    config.integrate.decay_s = 0.5;
    config.depth.distortion = {0.01, 0.01, 0.0, 0.0, 0.0};
    config.quality.max_at_one_value = 0.9;
    Mapper mapper = new_mapper(config);
    const MapReader reader = mapper.reader();
    std::vector<Frame> frames;
    for (int i = 0; i < 40; ++i) {
      Frame frame = test::random_frame(random, test::small_camera(80, 60));
      frame.T_world_camera = Transform<World, Camera>::trusted(frame.T_world_camera.rotation(),
                                                               Eigen::Vector3d(0.3 * i, 0.0, 0.0));
      frames.push_back(std::move(frame));
    }
    Stamp now;
    const auto fly = [&](Frame& frame) {
      frame.stamp = now = now + std::chrono::milliseconds(33);
      return mapper.integrate(frame);
    };
    for (int tour = 0; tour < 2; ++tour) {
      for (Frame& frame : frames) fly(frame);
    }

    std::size_t shifts = 0, decayed = 0;
    const test::AllocationCount allocations;
    for (Frame& frame : frames) {
      const MapUpdate update = fly(frame);
      shifts += update.shift.moved ? 1 : 0;
      decayed += update.decayed;
    }
    const std::size_t made = allocations.so_far();
    EXPECT_GT(decayed, 0U);
    EXPECT_EQ(made, 0U) << integrator << ", " << model;
    EXPECT_GT(shifts, 5U);
    EXPECT_TRUE(reader.latest());
  };
  for (const auto& integrator : integrators()) {
    for (const auto& model : measurement_models()) expect_none(integrator.name, model.name);
  }
}

TEST(Mapper, books_the_time_of_every_stage) {
  Mapper mapper = new_mapper();
  const MapUpdate update = mapper.integrate(test::wall_frame(test::small_camera(160, 120), 3.0));
  for (const Nanoseconds t : update.times.of) EXPECT_GE(t.count(), 0);
  EXPECT_GT(update.times.total().count(), 0);
}

TEST(MapperConfig, has_no_faults_by_default) { EXPECT_TRUE(MapperConfig{}.faults().empty()); }

TEST(MapperConfig, names_every_field_that_cannot_be_used_at_once_and_each_one_time) {
  MapperConfig config;
  visit_config(config, [](const ConfigField&, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double>) value = std::numeric_limits<double>::quiet_NaN();
    if constexpr (std::is_same_v<Value, int>) value = -7;
    if constexpr (std::is_same_v<Value, Eigen::Vector3d>) value.setConstant(-1.0);
    if constexpr (std::is_same_v<Value, NewWorldRule>) value = static_cast<NewWorldRule>(3);
    if constexpr (std::is_same_v<Value, std::string>) value = "nonsense";
    if constexpr (std::is_same_v<Value, std::vector<std::string>>) value = {"nonsense"};
  });
  std::multiset<std::string> named;
  for (const Error& fault : config.faults()) named.insert(fault.where);
  visit_config(config, [&](const ConfigField& field, const auto&) {
    EXPECT_EQ(named.count(std::string(field.key)), 1U) << field.key;
  });
}

}  // namespace
}  // namespace swiftlet
