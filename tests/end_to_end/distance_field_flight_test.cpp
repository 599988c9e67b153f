// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The distance field in flight, after every frame, against a search: a million voxels and more.

#include "end_to_end/rig_flights.hpp"
#include "support/distance_check.hpp"

namespace swiftlet {
namespace {

TEST(DistanceFieldInFlight, equals_a_search_in_a_million_voxels_of_a_flight_through_a_room) {
  const test::TempFolder folder;
  test::write_file(folder / "room.yaml", test::kRoom);
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.map.size_m = {4.0, 4.0, 2.0};  // smaller than the room, so that it has to move
  config.map.trigger_m = {0.2, 0.2, 0.2};
  config.depth.downsample = 2;
  config.sensor.baseline_m = 0.265;
  const auto flight =
      test::check_distances("sim:" + (folder / "room.yaml").string(), config, 1.0, 1000, 4000);
  EXPECT_GE(flight.checked, 1'000'000U);
  EXPECT_GT(flight.near, flight.checked / 20);
  EXPECT_GE(flight.moves, 4U);
}

}  // namespace
}  // namespace swiftlet
