// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/companion.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "mavlink/recording_outlet.hpp"
#include "support/hand_made_map.hpp"
#include "swiftlet/mavlink/wire/system_messages.hpp"

namespace swiftlet::mavlink {
namespace {

using namespace std::chrono_literals;
using test::RecordingOutlet;

/// A flight told by hand: time stands until it is moved on.
class ToldFlight {
 public:
  explicit ToldFlight(CompanionOptions options = {}) : companion_(options, news_) {
    map_.fill_window(test::kFree);
    map_.fill({2, -3, -1}, {2, 3, 1}, test::kOccupied);
  }

  /// A map begins and is published.
  void begin_map() {
    auto reader = map_.map().reader();
    map_.map().publish({1});
    news_.map_begun(std::move(reader));
  }
  /// Frames 30 times a second, or ticks alone, for a while.
  void fly(Nanoseconds duration, bool has_frames = true) {
    for (const HostTime end = now + duration; now < end; now += 5ms) {
      if (has_frames && now - last_frame_ >= 33ms) {
        last_frame_ = now;
        x_m += 0.033;
        news_.mapped({.T_world_body = Transform<World, Body>::trusted(
                          Eigen::Quaterniond::Identity(), {x_m, 0, 0}),
                      .taken_at = now - 20ms,
                      .mapped_at = now,
                      .pose_epoch = epoch});
      }
      out.now = now;
      companion_.tick(now, out);
    }
  }
  template <class Message>
  void hear(const Message& message, Address from = {1, 1}) {
    PacketWriter writer(from);
    PacketParser parser;
    parser.feed(writer.write(message, {}).bytes(), {}, [&](const Packet& packet) {
      out.now = now;
      companion_.received(0, packet, now, out);
    });
  }
  [[nodiscard]] FlightNews& news() { return news_; }
  [[nodiscard]] const CompanionReport& report() const { return companion_.report(); }

  RecordingOutlet out;
  HostTime now{1000s};
  std::uint32_t epoch = 0;
  double x_m = -1;

 private:
  test::HandMadeMap map_{0.2, {8, 8, 3}};
  FlightNews news_;
  Companion companion_;
  HostTime last_frame_{};
};

std::string_view text_of(const StatusText& message) { return message.text.data(); }

constexpr Heartbeat kPx4Heartbeat{.type = 2, .autopilot = codes::kAutopilotPx4, .system_status = 4};

double ms(Nanoseconds time) { return 1e3 * seconds(time); }

TEST(Companion, tells_of_itself_once_a_second_and_of_obstacles_fifteen_times) {
  ToldFlight flight;
  flight.fly(2s, false);
  EXPECT_EQ(flight.out.all<Heartbeat>().size(), 2U);
  EXPECT_EQ(flight.out.all<Heartbeat>().back().system_status, codes::kStateStandby);
  EXPECT_EQ(flight.out.all<ObstacleDistance>().size(), 0U);
  flight.begin_map();
  const HostTime begin = flight.now;
  flight.fly(4s);
  EXPECT_NEAR(static_cast<double>(flight.out.all<Heartbeat>(begin).size()), 4, 1);
  EXPECT_EQ(flight.out.all<Heartbeat>().back().system_status, codes::kStateActive);
  EXPECT_NEAR(static_cast<double>(flight.out.all<ObstacleDistance>(begin).size()), 60, 6);
  EXPECT_EQ(flight.out.all<Odometry>().size(), 0U);  // not asked for
}

TEST(Companion, tells_the_wall_ahead_from_where_the_vehicle_is_now) {
  ToldFlight flight;
  flight.begin_map();
  flight.fly(2s);
  const auto told = flight.out.all<ObstacleDistance>();
  for (const auto& message : {told.front(), told.back()}) EXPECT_EQ(message.frame, 12);
  EXPECT_NEAR(told.front().distances[0], 100 * (2.0 - -1.0), 10);
  EXPECT_NEAR(told.back().distances[0], 100 * (2.0 - flight.x_m), 10);
  EXPECT_EQ(flight.report().told_cm, told.back().distances);
}

TEST(Companion, tells_poses_both_autopilots_take_and_counts_their_jumps) {
  ToldFlight flight({.poses = PoseTelling::kOdometry});
  flight.begin_map();
  flight.fly(2s);
  const auto before = flight.out.all<Odometry>();
  ASSERT_NEAR(static_cast<double>(before.size()), 57, 4);
  EXPECT_EQ(before.back().frame_id, 20);
  EXPECT_EQ(before.back().child_frame_id, 12);
  EXPECT_EQ(before.back().estimator_type, 3);
  EXPECT_EQ(before.back().quality, 100);
  EXPECT_EQ(before.back().reset_counter, 0);
  EXPECT_NEAR(before.back().vx, 0.033 / 0.035, 0.02);
  EXPECT_GT(before.back().pose_covariance[0], 0);
  const HostTime jump = flight.now;
  flight.epoch = 1;
  flight.fly(1s);
  for (const Odometry& message : flight.out.all<Odometry>(jump))
    EXPECT_EQ(message.reset_counter, 1);
}

TEST(Companion, answers_for_its_clock_and_asks_for_the_vehicle_s) {
  ToldFlight flight;
  flight.hear(kPx4Heartbeat);
  flight.hear(Timesync{.ts1 = 12'345});
  const auto answers = flight.out.all<Timesync>();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].ts1, 12'345);
  EXPECT_EQ(answers[0].tc1, Nanoseconds(flight.now.time_since_epoch()).count());
  EXPECT_EQ(answers[0].target_system, 1);
  flight.fly(5ms);
  const Timesync question = flight.out.all<Timesync>().back();
  ASSERT_EQ(question.tc1, 0);
  flight.now += 5ms;  // it took 10 ms there and back; the vehicle has run for 100 s
  flight.hear(Timesync{.tc1 = 100'005'000'000, .ts1 = question.ts1});
  EXPECT_EQ(flight.report().vehicle->clock_offset, 900s);
  EXPECT_EQ(flight.report().vehicle->clock_round_trip, 10ms);
}

TEST(Companion, listens_to_one_autopilot_and_speaks_as_its_system) {
  ToldFlight flight;
  flight.hear(Heartbeat{.type = codes::kTypeGcs, .autopilot = codes::kAutopilotNone}, {255, 190});
  EXPECT_FALSE(flight.report().vehicle);
  flight.hear(kPx4Heartbeat, {7, 1});
  flight.hear(Heartbeat{.autopilot = codes::kAutopilotArduPilot, .base_mode = codes::kModeIsArmed},
              {8, 1});
  flight.hear(Timesync{.ts1 = 5}, {8, 1});
  EXPECT_EQ(flight.report().vehicle->address.system, 7);
  EXPECT_FALSE(flight.report().vehicle->is_armed);
  EXPECT_TRUE(flight.out.all<Timesync>().empty());
  flight.fly(10ms, false);
  EXPECT_EQ(flight.out.sent().back().packet.from, (Address{7, 196}));
}

/// The table of docs/autopilot.md: what happens, what is sent, how soon.
TEST(Companion, stops_telling_obstacles_soon_after_frames_stop_and_says_so_at_once) {
  ToldFlight flight;
  flight.begin_map();
  flight.fly(2s);
  const HostTime stop = flight.now;
  flight.fly(3s, false);
  const auto last_ring = flight.out.last<ObstacleDistance>();
  const auto said = flight.out.first<StatusText>(stop);
  ASSERT_TRUE(last_ring && said);
  EXPECT_LE(*last_ring - stop, 300ms);
  EXPECT_LE(*said - stop, 310ms);
  const auto critical = flight.out.all<Heartbeat>(*said);
  ASSERT_FALSE(critical.empty());
  EXPECT_EQ(critical.front().system_status, codes::kStateCritical);
  EXPECT_LE(*flight.out.first<Heartbeat>(*said) - stop, 310ms);
  EXPECT_EQ(flight.out.all<StatusText>(stop).size(), 1U);
  std::printf(
      "[ told     ] frames stop: last ring after %.0f ms, STATUSTEXT and CRITICAL after %.0f ms\n",
      ms(*last_ring - stop), ms(*said - stop));
  const HostTime back = flight.now;
  flight.fly(1s);
  EXPECT_LE(*flight.out.first<ObstacleDistance>(back) - back, 70ms);
  EXPECT_EQ(flight.out.all<Heartbeat>(back).front().system_status, codes::kStateActive);
}

TEST(Companion, tells_of_a_new_world_with_its_first_frame) {
  ToldFlight flight({.poses = PoseTelling::kVisionPosition});
  flight.begin_map();
  flight.fly(1s);
  flight.epoch = 1;
  const HostTime jump = flight.now;
  flight.fly(100ms);
  EXPECT_LE(*flight.out.first<StatusText>(jump) - jump, 40ms);
  EXPECT_EQ(text_of(flight.out.all<StatusText>(jump)[0]),
            "mapper: pose was lost, a new map begins");
  EXPECT_EQ(flight.out.all<VisionPositionEstimate>(jump).front().reset_counter, 1);
}

TEST(Companion, passes_on_what_the_pilot_must_know_cut_to_what_fits) {
  ToldFlight flight;
  flight.news().tell_pilot(Urgency::kWarning, std::string(60, 'x'));
  flight.fly(5ms);
  const auto texts = flight.out.all<StatusText>();
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(texts[0].severity, 4);
  EXPECT_EQ(std::string_view(texts[0].text.data(), 50), std::string(50, 'x'));
}

}  // namespace
}  // namespace swiftlet::mavlink
