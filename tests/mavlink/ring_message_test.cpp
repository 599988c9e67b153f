// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/ring/ring_message.hpp"

#include <gtest/gtest.h>

#include "mavlink/receiver_model.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr RingTelling kTen{.max_m = 10, .least_known_m = 2};

std::array<std::uint16_t, kSectors> px4(const ObstacleRing& ring) {
  return tell_ring(ring, kTen, RingReader::kPx4);
}

TEST(RingMessage, has_the_one_form_that_every_receiver_reads_right) {
  const auto message = obstacle_distance({}, kTen, RingReader::kPx4, 7);
  EXPECT_EQ(message.time_usec, 7U);
  EXPECT_EQ(message.frame, 12);
  EXPECT_EQ(message.increment, 5);
  EXPECT_EQ(message.increment_f, 0.0F);
  EXPECT_EQ(message.angle_offset, 0.0F);
  EXPECT_EQ(message.min_distance, 0);
  EXPECT_EQ(message.max_distance, 1000);
  test::Px4With36Bins half;
  test::Px4With72Bins whole;
  test::ArduPilotFaces faces;
  half.take(message);  // no index is out of range
  whole.take(message);
  faces.take(message);
  for (std::size_t i = 0; i < kSectors; ++i) {
    EXPECT_EQ(half.has_read(i), i % 2 == 0);  // that is why even sectors speak for their neighbours
    EXPECT_TRUE(whole.has_read(i));
    EXPECT_TRUE(faces.has_read(i));
  }
}

TEST(RingMessage, the_model_fails_on_what_real_receivers_read_out_of_bounds) {
  ObstacleDistance message = obstacle_distance({}, kTen, RingReader::kPx4, 0);
  message.increment_f = 1.21F;  // as a public script sends a camera's 87 degrees
  message.angle_offset = -43.5F;
  test::Px4With36Bins half;
  EXPECT_EQ(half.reads_outside(message), 27);
}

TEST(RingMessage, tells_free_unknown_and_obstacles_apart) {
  ObstacleRing ring;
  ring.sectors[10].occupied_m = 3.456;
  ring.sectors[20].unknown_m = 0.9;
  ring.sectors[30].unknown_m = 6.0;
  ring.sectors[40] = {.occupied_m = 5.0, .unknown_m = 4.0};
  const auto told = px4(ring);
  EXPECT_EQ(told[10], 345);
  EXPECT_EQ(told[20], kSectorUnknown);
  EXPECT_EQ(told[30], 600);  // the known ends there
  EXPECT_EQ(told[40], 400);
  EXPECT_EQ(told[50], 1001);
}

TEST(RingMessage, tells_of_the_touching_and_the_far_within_the_limits_of_the_message) {
  ObstacleRing ring;
  ring.sectors[1].occupied_m = 0.0;
  ring.sectors[5].occupied_m = 10.0;
  EXPECT_EQ(px4(ring)[1], 1);
  EXPECT_EQ(px4(ring)[5], 1000);
  const RingTelling endless{.max_m = 1e6};
  EXPECT_EQ(tell_ring({}, endless, RingReader::kPx4)[0], 65'534);
}

TEST(RingMessage, has_even_sectors_speak_for_their_neighbours_but_not_for_the_unknown) {
  ObstacleRing ring;
  ring.sectors[11].occupied_m = 2.0;
  ring.sectors[21].unknown_m = 0.5;
  ring.sectors[32].unknown_m = 0.5;
  ring.sectors[31].occupied_m = 3.0;
  const auto told = px4(ring);
  EXPECT_EQ(told[10], 200);
  EXPECT_EQ(told[11], 200);
  EXPECT_EQ(told[12], 200);
  EXPECT_EQ(told[9], 1001);
  EXPECT_EQ(told[20], kSectorUnknown);  // half of what a reader takes from it is
  EXPECT_EQ(told[22], kSectorUnknown);
  EXPECT_EQ(told[32], kSectorUnknown);  // and not free up to its neighbour's wall
  EXPECT_EQ(told[30], 300);
}

TEST(RingMessage, does_not_hide_from_ardupilot_what_it_would_then_take_for_free) {
  ObstacleRing ring;
  ring.sectors[8] = {.occupied_m = 3.0, .unknown_m = 0.7};
  EXPECT_EQ(px4(ring)[8], kSectorUnknown);
  EXPECT_EQ(tell_ring(ring, kTen, RingReader::kArduPilot)[8], 300);
  EXPECT_EQ(tell_ring(ring, kTen, RingReader::kArduPilot)[9], 1001);
}

}  // namespace
}  // namespace swiftlet::mavlink
