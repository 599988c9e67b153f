// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/map_model.hpp"

#include <gtest/gtest.h>

#include <set>

#include "station/station_world.hpp"

namespace swiftlet::station {
namespace {

TEST(MapModel, knows_exactly_the_map_inside_the_window_and_what_left_it) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  for (int i = 0; i < 300; ++i) {
    flight.step();
    if (random.chance(0.6)) continue;  // many frames between two looks
    (void)model.poll();
    ASSERT_EQ(model.map().digest(), flight.truth()) << "frame " << i << ", " << random.repeat();
  }
}

TEST(MapModel, names_every_block_that_changed) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> before;
  for (int i = 0; i < 60; ++i) {
    flight.step();
    const MapModel::Update update = model.poll();
    const std::set<BlockIndex> changed(update.changed.begin(), update.changed.end());
    EXPECT_EQ(changed.size(), update.changed.size()) << "each once";
    std::unordered_map<BlockIndex, VoxelBlock, BlockHash> now;
    model.map().for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
      now.emplace(index, block);
      const auto old = before.find(index);
      const bool is_same = old != before.end() && old->second == block;
      EXPECT_TRUE(is_same || changed.contains(index)) << random.repeat();
    });
    for (const auto& [index, block] : before) {
      EXPECT_TRUE(now.contains(index) || changed.contains(index)) << random.repeat();
    }
    before = std::move(now);
  }
}

TEST(MapModel, shows_the_trigger_box_where_the_window_was_moved_to) {
  test::Random random;
  RandomFlight flight(random);
  flight.step();
  MapModel model(flight.feed);
  (void)model.poll();
  FrameReport ahead;
  ahead.has_shifted = true;
  ahead.T_world_camera =
      Transform<World, Camera>::trusted(Eigen::Quaterniond::Identity(), {1.0, 2.0, 0.5});
  flight.feed.report(ahead);
  (void)model.poll();
  EXPECT_EQ(model.status().trigger_centre_m, Eigen::Vector3d(1.0, 2.0, 0.5));
  ahead.window_goal = {4.0, 2.0, 0.5};  // map.lookahead_s
  flight.feed.report(ahead);
  (void)model.poll();
  EXPECT_EQ(model.status().trigger_centre_m, Eigen::Vector3d(4.0, 2.0, 0.5));
}

TEST(MapModel, begins_anew_with_a_new_world) {
  test::Random random;
  RandomFlight first(random);
  MapModel model(first.feed);
  EXPECT_EQ(model.world(), 0U);
  EXPECT_EQ(model.state(), FlightState::kWaiting);
  first.step();
  EXPECT_TRUE(model.poll().is_new_world);
  EXPECT_EQ(model.state(), FlightState::kFlying);
  EXPECT_GT(model.map().digest().blocks, 0U);

  auto other = *RollingMap::create({});
  first.feed.begin_world(other.reader(), small_info());
  FrameReport report;
  report.number = 7;
  first.feed.report(report);
  const MapModel::Update update = model.poll();
  EXPECT_TRUE(update.is_new_world);
  EXPECT_EQ(model.world(), 2U);
  EXPECT_EQ(model.map().digest(), MapDigest{});
  ASSERT_EQ(update.frames.size(), 1U);
  EXPECT_EQ(update.frames[0].number, 7U);
  first.feed.finish();
  EXPECT_EQ(model.state(), FlightState::kOver);
}

TEST(MapModel, counts_frames_by_verdict_and_keeps_what_was_lost) {
  LiveFeed feed;
  auto map = *RollingMap::create({});
  feed.begin_world(map.reader(), small_info());
  MapModel model(feed);
  FrameReport report;
  for (const int verdict : {0, 1, 1, 77}) {  // a verdict without a name is not counted
    report.verdict = static_cast<std::uint8_t>(verdict);
    feed.report(report);
  }
  EXPECT_EQ(model.poll().frames.size(), 4U);
  EXPECT_EQ(model.status().verdicts, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(model.status().losses, (std::vector<std::uint32_t>{0, 0}));
  feed.lost({0, 5});  // while no frame comes
  EXPECT_EQ(model.status().losses, (std::vector<std::uint32_t>{0, 5}));
}

TEST(MapMirror, forgets_far_blocks_and_never_those_of_the_window) {
  constexpr std::size_t kMost = 100;
  MapMirror mirror({}, kMost);
  VoxelBlock block;
  block.clear();
  block.voxels[3] = 200;
  for (std::int32_t i = 0; i < 300; ++i) mirror.put({i, 0, 0}, block, 1);
  (void)mirror.take_changes();
  auto map = *RollingMap::create({0.1, {2.0, 2.0, 1.0}, {0.5, 0.5, 0.5}});
  map.recentre({200.0, 0.0, 0.0}, nullptr);  // block 250
  map.writable(block_of(voxel_containing({200.0, 0.0, 0.0}, 0.1))) = block;
  mirror.update(*map.snapshot({1}));
  EXPECT_LE(mirror.digest().blocks, kMost);
  EXPECT_NE(mirror.find({250, 0, 0}), nullptr);
  EXPECT_NE(mirror.find({256, 0, 0}), nullptr) << "near";
  EXPECT_EQ(mirror.find({0, 0, 0}), nullptr) << "far";
  EXPECT_EQ(mirror.take_changes().size(), 300 - mirror.digest().blocks);
}

TEST(ReportRing, drops_what_has_no_room_and_counts_it) {
  ReportRing ring(4);
  FrameReport report;
  for (report.number = 1; report.number <= 6; ++report.number) (void)ring.push(report);
  EXPECT_EQ(ring.missed(), 2U);
  std::vector<std::uint32_t> numbers;
  ring.drain([&](const FrameReport& r) { numbers.push_back(r.number); });
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_TRUE(ring.push(report));
}

}  // namespace
}  // namespace swiftlet::station
