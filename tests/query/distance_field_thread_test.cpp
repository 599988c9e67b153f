// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/distance/distance_field_thread.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "support/allocations.hpp"
#include "support/brute_distance.hpp"
#include "support/seeds.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {
namespace {

using test::same_bits;

/// A map whose vehicle flies, and the thread that follows it.
struct Flight {
  explicit Flight(test::Random& random, const DistanceFieldOptions& field_options = {})
      : random(random), options(field_options) {
    map = *RollingMap::create({.voxel_m = 0.2, .size_m = {6, 5, 3}, .trigger_m = {0.5, 0.5, 0.5}});
    thread = start();
  }
  DistanceFieldThread start() {
    return *DistanceFieldThread::start(map->reader(), 0.2, map->window().size, options);
  }

  /// The next frame: the vehicle has moved on, and some voxels changed.
  void fly_on() {
    vehicle += random.vector(-0.3, 0.4);
    map->recentre(vehicle, nullptr);
    const BlockWindow& w = map->window();
    for (int i = 0; i < 5; ++i) {
      const BlockIndex b{w.first.x + random.integer(0, w.size.x - 1),
                         w.first.y + random.integer(0, w.size.y - 1),
                         w.first.z + random.integer(0, w.size.z - 1)};
      for (QuantizedLogOdds& voxel : map->writable(b).voxels)
        voxel = random.chance(0.02) ? 220 : 20;
    }
    map->publish({++frames});
  }
  /// Waits for the field of the newest frame.
  HeldDistanceField newest() {
    for (;;) {
      auto field = thread->latest();
      if (field && (*field)->frame_count() == frames) return *field;
      field.reset();
      std::this_thread::yield();
    }
  }
  DistanceField from_scratch() {
    DistanceField field = *DistanceField::create(0.2, map->window().size, options);
    field.update(*map->snapshot({frames}));
    return field;
  }

  test::Random& random;
  DistanceFieldOptions options;
  std::optional<RollingMap> map;
  std::optional<DistanceFieldThread> thread;
  Eigen::Vector3d vehicle{0, 0, 0};
  std::uint64_t frames = 0;
};

TEST(DistanceFieldThread, publishes_the_field_of_every_frame_that_it_is_given_time_for) {
  test::Random random;
  Flight flight(random);
  EXPECT_FALSE(flight.thread->latest()) << "before the first frame there is none";
  for (int i = 0; i < 40; ++i) {
    flight.fly_on();
    const HeldDistanceField field = flight.newest();
    ASSERT_TRUE(same_bits(*field, flight.from_scratch())) << "frame " << flight.frames;
  }
}

// Readers look at whatever is newest while the map goes on as fast as it can.
TEST(DistanceFieldThread, shows_readers_whole_fields_that_never_change) {
  test::Random random;
  Flight flight(random, {.max_distance_m = 1.0, .occupied = false});
  std::atomic<bool> is_flying{true};
  std::atomic<std::size_t> looks{0};
  const auto read = [&] {
    std::uint64_t last = 0;
    while (is_flying || looks < 10) {
      const auto field = flight.thread->latest();
      if (!field) continue;
      ASSERT_GE((*field)->frame_count(), last) << "time does not go back";
      last = (*field)->frame_count();
      // A whole field obeys the law of every distance: neighbours differ by a voxel at most.
      const VoxelBox box = voxel_box((*field)->box());
      const auto at = [&](int x, int y, int z) {
        const VoxelIndex v{box.first.x + x, box.first.y + y, box.first.z + z};
        return (*field)->distance(v, Obstacles::kNotFree).distance_m;
      };
      const double before = at(8, 8, 8);
      for (int i = 0; i < 15; ++i) {
        ASSERT_LE(std::abs(at(i, 7, 9) - at(i + 1, 7, 9)), 0.2 + 1e-6);
        ASSERT_LE(std::abs(at(9, i, 7) - at(9, i + 1, 7)), 0.2 + 1e-6);
      }
      ASSERT_EQ(at(8, 8, 8), before);
      ++looks;
    }
  };
  std::thread one(read), two(read);
  for (int i = 0; i < 300; ++i) flight.fly_on();
  static_cast<void>(flight.newest());
  is_flying = false;
  one.join();
  two.join();
  EXPECT_GT(looks, 0U);
}

TEST(DistanceFieldThread, goes_on_when_a_reader_lets_go_of_the_last_field_it_held) {
  test::Random random;
  Flight flight(random);
  std::vector<HeldDistanceField> held;
  for (int i = 0; i < DistanceFieldThread::kFields; ++i) {
    flight.fly_on();
    held.push_back(flight.newest());
  }
  const DistanceField first = [&] {
    const HeldDistanceField& oldest = held.front();
    EXPECT_EQ(oldest->frame_count(), 1U);
    return flight.from_scratch();
  }();
  EXPECT_TRUE(same_bits(*held.back(), first));
  flight.fly_on();
  while (flight.thread->tally().skipped == 0) std::this_thread::yield();
  EXPECT_EQ((*flight.thread->latest())->frame_count(), 3U) << "every field is held";
  EXPECT_TRUE(same_bits(*held.back(), first)) << "what is held does not change";
  held.erase(held.begin());
  EXPECT_EQ(flight.newest()->frame_count(), 4U);
  EXPECT_EQ(flight.thread->tally().published, 4U);
}

TEST(DistanceFieldThread, leaves_held_fields_good_when_it_ends) {
  test::Random random;
  Flight flight(random);
  flight.fly_on();
  const HeldDistanceField field = flight.newest();
  flight.thread.reset();
  EXPECT_TRUE(same_bits(*field, flight.from_scratch()));
}

TEST(DistanceFieldThread, allocates_nothing_while_the_map_grows) {
  test::Random random;
  Flight flight(random, {.is_signed = true});
  for (int i = 0; i < 5; ++i) {
    flight.fly_on();
    static_cast<void>(flight.newest());
  }
  const test::AllocationCount allocations;
  for (int i = 0; i < 20; ++i) {
    flight.fly_on();
    static_cast<void>(flight.newest());
  }
  EXPECT_EQ(allocations.so_far(), 0U);
}

TEST(DistanceFieldThread, says_why_it_cannot_start) {
  auto map = RollingMap::create({.voxel_m = 0.2, .size_m = {2, 2, 2}});
  const auto thread =
      DistanceFieldThread::start(map->reader(), 0.2, map->window().size, {.max_distance_m = -1.0});
  ASSERT_FALSE(thread);
  EXPECT_EQ(thread.error().text(),
            "distance field: max_distance_m is less than a voxel; give at least the map's voxel_m");
}

}  // namespace
}  // namespace swiftlet
