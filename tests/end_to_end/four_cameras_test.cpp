// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include "end_to_end/rig_flights.hpp"
#include "support/map_bits.hpp"

namespace swiftlet {
namespace {

/// The furnished room, and a flight in it without a turn.
std::string room_without_turns() {
  std::string room(test::kRoom);
  room.erase(room.find("flight:"));
  return room + R"(flight:
  waypoints:
    - { at_m: [-0.6, 0.2, 1.2] }
    - { at_m: [0.4, -0.2, 1.3], leg_s: 3 }
)";
}

/// Whether the walls in the four directions of a camera height are in the map.
int walls_seen(const Mapper& mapper) {
  const auto is_occupied = [&](VoxelIndex v) {
    return mapper.config().occupancy.classify(mapper.map().log_odds(v)) == Occupancy::kOccupied;
  };
  const auto is_seen = [&](VoxelIndex a, VoxelIndex b) { return is_occupied(a) || is_occupied(b); };
  return int{is_seen({30, 3, 12}, {29, 3, 12})} + int{is_seen({-31, 3, 12}, {-30, 3, 12})} +
         int{is_seen({3, 25, 12}, {3, 24, 12})} + int{is_seen({3, -26, 12}, {3, -25, 12})};
}

TEST(FourCameras, see_all_around_in_one_flight_without_a_turn) {
  const auto one = test::fly_room("", room_without_turns());
  const auto four = test::fly_room("?cameras=4", room_without_turns());
  EXPECT_EQ(walls_seen(one.mapper), 1);
  EXPECT_EQ(walls_seen(four.mapper), 4);
  EXPECT_GE(four.tally.delivered, 4 * one.tally.delivered - 4);

  // What all four see is as right as what one sees.
  const auto truth = test::fly_room("?cameras=4&noise=off", room_without_turns());
  EXPECT_GT(test::score_of(four.mapper, truth.mapper).accuracy(), 0.97);
}

TEST(FourCameras, give_the_same_bits_for_every_order_of_arrival_within_a_period) {
  auto sorted = test::fly_room("?cameras=4&frames=120", room_without_turns());
  const auto reference = test::bits_of(sorted.mapper);
  EXPECT_GT(reference.known_voxels, 1000U);
  for (const std::string seed : {"1", "2", "3"}) {
    auto shuffled = test::fly_room("?cameras=4&frames=120&shuffle=" + seed, room_without_turns());
    EXPECT_EQ(test::bits_of(shuffled.mapper), reference);
    EXPECT_EQ(shuffled.tally.delivered, sorted.tally.delivered);
  }
  auto other = test::fly_room("?cameras=4&frames=120&seed=99", room_without_turns());
  EXPECT_NE(test::bits_of(other.mapper), reference) << "or the test shows nothing";
}

}  // namespace
}  // namespace swiftlet
