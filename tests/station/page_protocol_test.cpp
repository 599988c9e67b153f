// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <algorithm>

#include "station/station_world.hpp"
#include "station/wire_reader.hpp"
#include "swiftlet/station/client_protocol.hpp"

namespace swiftlet::station {
namespace {

using namespace std::chrono_literals;
using Time = ClientProtocol::Time;

const OccupancyThresholds kThresholds{};

/// A protocol, its client, and a clock that only the test moves.
struct Conversation {
  explicit Conversation(const MapModel& model) : protocol(make_page_protocol(model)) {}

  /// The next message, whether it arrives or not; false if there is none for now.
  bool exchange(bool arrives = true) {
    const auto message = protocol->next(now);
    if (!message) return false;
    if (message->is_text || !arrives) return true;
    const auto sequence = WireReader::at<std::uint32_t>(message->data, 4);
    if (sequence != client.next_sequence) say({1, 0, 0, 0}, {client.next_sequence, sequence - 1});
    client.read(message->data);
    return true;
  }
  void exchange_all() {
    while (exchange()) {
    }
  }
  void say(Bytes message, const std::vector<std::uint32_t>& words = {}) {
    for (const std::uint32_t word : words) {
      for (unsigned i = 0; i < 4; ++i) {
        message.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
      }
    }
    EXPECT_TRUE(protocol->received(false, message, now));
  }
  MapDigest digest() const { return client.digest(kThresholds); }

  std::unique_ptr<ClientProtocol> protocol;
  WireReader client;
  Time now = Time{} + 1h;
};

TEST(PageProtocol, brings_a_client_to_exactly_the_map_and_proves_it) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  Conversation pair(model);
  for (int i = 0; i < 80; ++i) {
    flight.step();
    pair.protocol->saw(model.poll());
    if (random.chance(0.5)) pair.exchange_all();
    pair.now += 50ms;
  }
  pair.exchange_all();
  EXPECT_EQ(pair.digest(), model.map().digest()) << random.repeat();
  EXPECT_EQ(pair.client.checksum, model.map().digest()) << random.repeat();
  EXPECT_EQ(pair.client.frame_numbers.size(), 80U);
}

TEST(PageProtocol, tells_the_newest_course_and_leaves_a_capped_link_to_the_map) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  Conversation pair(model);
  Course course;
  course.path.resize(100);
  std::size_t bytes = 0, courses = 0;
  std::uint64_t newest = 0;
  const auto fly_on = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      flight.step();
      ++course.frame_count;
      flight.feed.course(course);
      pair.protocol->saw(model.poll());
      while (const auto message = pair.protocol->next(pair.now)) {
        if (message->is_text || message->data[0] != 5) continue;
        newest = WireReader::at<std::uint64_t>(message->data, 12);
        bytes += message->data.size();
        ++courses;
      }
      pair.now += 50ms;
    }
  };
  fly_on(200);  // 10 s
  EXPECT_NEAR(static_cast<double>(courses), 50.0, 2.0);
  EXPECT_GE(newest + 4, course.frame_count);
  pair.say({4, 0, 0, 0}, {8000});
  bytes = 0;
  fly_on(400);  // 20 s
  EXPECT_GT(bytes, 1664U);
  EXPECT_LT(bytes, 20 * 800 + 2 * 1664U);
  // A client that comes late gets it at once.
  const auto late = make_page_protocol(model);
  std::vector<int> kinds;
  while (const auto message = late->next(pair.now))
    if (!message->is_text) kinds.push_back(message->data[0]);
  EXPECT_EQ(std::ranges::count(kinds, 5), 1);
}

TEST(PageProtocol, heals_whatever_is_lost_on_the_way) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  Conversation pair(model);
  for (int i = 0; i < 150; ++i) {
    flight.step();
    pair.protocol->saw(model.poll());
    while (pair.exchange(!random.chance(0.3))) {
    }
    pair.now += 50ms;
  }
  flight.step();
  for (int i = 0; i < 3; ++i) {  // a client notices a loss by the message after it
    pair.protocol->saw(model.poll());
    pair.exchange_all();
    pair.now += 1s;
  }
  EXPECT_EQ(pair.digest(), model.map().digest()) << random.repeat();
}

TEST(PageProtocol, sends_everything_again_when_a_loss_is_too_long_ago) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  Conversation pair(model);
  flight.step();
  pair.protocol->saw(model.poll());
  pair.exchange_all();
  const auto packets = pair.client.next_sequence + 3 * ClientQueue::kPacketsRemembered;
  while (pair.client.next_sequence < packets) {
    flight.step();
    pair.protocol->saw(model.poll());
    pair.exchange_all();
    pair.now += 1s;
  }
  pair.client.blocks.clear();
  pair.say({1, 0, 0, 0}, {0, 2});
  pair.exchange_all();
  EXPECT_EQ(pair.digest(), model.map().digest()) << random.repeat();
}

TEST(PageProtocol, keeps_to_the_bandwidth_and_still_completes_the_map) {
  test::Random random;
  RandomFlight flight(random);
  for (int i = 0; i < 40; ++i) flight.step();
  MapModel model(flight.feed);
  const MapModel::Update update = model.poll();
  Conversation pair(model);
  constexpr std::uint32_t kRate = 125'000;  // 1 Mbit/s
  pair.say({4, 0, 0, 0}, {kRate});
  pair.protocol->saw(update);
  const Time start = pair.now;
  while (!pair.client.checksum) {
    pair.exchange_all();
    pair.now += 10ms;
    const double passed_s = std::chrono::duration<double>(pair.now - start).count();
    // A tenth of a second at once, and one message of debt.
    ASSERT_LE(static_cast<double>(pair.client.bytes), kRate * (passed_s + 0.1) + 40'000);
    ASSERT_LT(passed_s, 60.0) << random.repeat();
  }
  EXPECT_GT(pair.now - start, 100ms) << "the map was too small to tell";
  EXPECT_EQ(pair.digest(), model.map().digest()) << random.repeat();
}

TEST(PageProtocol, a_slow_client_gets_fewer_updates_and_never_an_older_map) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  Conversation pair(model);
  for (int i = 0; i < 200; ++i) {
    flight.step();
    pair.protocol->saw(model.poll());
    pair.now += 50ms;
    (void)pair.exchange();  // one message a poll, far less than what changes
  }
  // Each message holds its blocks as they are now: what waits is a set of places, not of states.
  pair.client.blocks.clear();
  const auto message = [&] {
    for (;;) {
      auto next = pair.protocol->next(pair.now);
      if (next && !next->is_text && next->data[0] == 1) return next->data;
    }
  }();
  pair.client.read(message);
  ASSERT_FALSE(pair.client.blocks.empty());
  for (const auto& [index, block] : pair.client.blocks) {
    ASSERT_NE(model.map().find(index), nullptr);
    EXPECT_EQ(*model.map().find(index), block);
  }
  pair.exchange_all();
  EXPECT_LE(pair.client.frame_numbers.size(), 600U) << "the frames that wait are bounded";
}

TEST(PageProtocol, sends_the_blocks_nearest_to_the_vehicle_first) {
  MapInfo info = small_info();
  MapMirror map;
  VoxelBlock block;
  block.clear();
  block.voxels[0] = 200;
  for (std::int32_t i = -200; i <= 200; ++i) map.put({i, 0, 0}, block, 1);
  MapModel model(info, std::move(map));
  Conversation pair(model);
  while (pair.client.blocks.empty()) ASSERT_TRUE(pair.exchange());
  EXPECT_EQ(pair.client.blocks.size(), ClientQueue::kMaxBlocksPerPacket);
  for (const auto& [index, voxels] : pair.client.blocks) EXPECT_LE(std::abs(index.x), 32);
}

TEST(PageProtocol, packs_blocks_that_lie_far_apart) {
  MapMirror map;
  VoxelBlock block;
  block.clear();
  block.voxels[511] = 1;
  for (const std::int32_t x : {-1'000'000, -32768, 0, 32767, 32768, 1'000'000}) {
    map.put({x, -x, x}, block, 1);
  }
  MapModel model(small_info(), std::move(map));
  Conversation pair(model);
  pair.exchange_all();
  EXPECT_EQ(pair.digest(), model.map().digest());
  EXPECT_EQ(pair.client.blocks.size(), 6U);
}

TEST(PageProtocol, holds_and_steps) {
  test::Random random;
  RandomFlight flight(random);
  MapModel model(flight.feed);
  Conversation pair(model);
  const auto fly_on = [&] {
    flight.step();
    pair.protocol->saw(model.poll());
    pair.now += 1s;
    pair.exchange_all();
  };
  fly_on();
  pair.say({3, 1, 0, 0});
  const MapDigest held = pair.digest();
  fly_on();
  fly_on();
  EXPECT_EQ(pair.digest(), held);
  pair.say({3, 2, 0, 0});
  pair.exchange_all();
  EXPECT_EQ(pair.digest(), model.map().digest()) << "a step brings it to the present";
  const MapDigest stepped = pair.digest();
  fly_on();
  EXPECT_EQ(pair.digest(), stepped) << "and holds again";
  pair.say({3, 0, 0, 0});
  pair.exchange_all();
  EXPECT_EQ(pair.digest(), model.map().digest());
}

TEST(ClientQueue, is_bounded_behind_a_client_that_takes_nothing) {
  MapMirror mirror;
  ClientQueue queue;
  for (std::int32_t i = 0; i < 100'000; i += 10) {
    std::vector<BlockIndex> changed;
    for (std::int32_t k = 0; k < 10; ++k) changed.push_back({i + k, 0, 0});
    queue.mark(changed, mirror);  // blocks that have come and gone
    ASSERT_LE(queue.pending(), 9000U);
  }
}

}  // namespace
}  // namespace swiftlet::station
