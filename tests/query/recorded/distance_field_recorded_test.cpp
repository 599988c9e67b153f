// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The distance field on a real Kinect recording of a room, after every frame, against a search.

#include <gtest/gtest.h>

#include "support/distance_check.hpp"
#include "support/recorded.hpp"

namespace swiftlet {
namespace {

TEST(DistanceFieldOfARoom, equals_a_search_in_a_million_voxels) {
  const auto folder = test::recorded_folder("sevenscenes_room200");
  SWIFTLET_NEEDS_RECORDING(folder);
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.map.size_m = {6.0, 6.0, 3.0};
  config.map.trigger_m = {0.3, 0.3, 0.3};
  const auto flight = test::check_distances("7scenes:" + folder.string(), config, 1.0, 100, 6000);
  EXPECT_GE(flight.checked, 1'000'000U);
  EXPECT_GT(flight.near, flight.checked / 20);
  EXPECT_GE(flight.moves, 2U);
}

}  // namespace
}  // namespace swiftlet
