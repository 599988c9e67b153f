// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/vehicle_poses.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/seeds.hpp"
#include "swiftlet/mavlink/companion/frd_axes.hpp"
#include "swiftlet/mavlink/wire/packet_parser.hpp"
#include "swiftlet/mavlink/wire/packet_writer.hpp"

namespace swiftlet::mavlink {
namespace {

using namespace std::chrono_literals;

class KeepingTaker final : public PoseTaker {
 public:
  void take(const PoseSample& pose) override { poses.push_back(pose); }
  void start_anew() override { ++resets; }
  std::vector<PoseSample> poses;
  int resets = 0;
};

/// A body that flies and turns, in our axes.
struct Truth {
  Eigen::Vector3d v_mps, w_radps;
  [[nodiscard]] Eigen::Vector3d position(double t_s) const { return v_mps * t_s; }
  [[nodiscard]] Eigen::Quaterniond rotation(double t_s) const {
    return Eigen::Quaterniond(Eigen::AngleAxisd(w_radps.norm() * t_s, w_radps.normalized()));
  }
};

/// An autopilot that started 900 s after this computer's clock and tells with whole milliseconds.
class ToldVehicle {
 public:
  static constexpr Nanoseconds kOffset = 900s;
  static constexpr Stamp kUnixAtStart{1'700'000'000'000'000'000};

  explicit ToldVehicle(const Truth& truth) : truth_(truth) {}

  void tell_attitude(std::uint32_t t_ms) {
    const Eigen::Quaternionf q = turned_about_x(truth_.rotation(1e-3 * t_ms)).cast<float>();
    hear(
        AttitudeQuaternion{
            .time_boot_ms = t_ms, .q1 = q.w(), .q2 = q.x(), .q3 = q.y(), .q4 = q.z()},
        t_ms);
  }
  void tell_position(std::uint32_t t_ms) {
    const Eigen::Vector3f p = turned_about_x(truth_.position(1e-3 * t_ms)).cast<float>();
    hear(LocalPositionNed{.time_boot_ms = t_ms, .x = p.x(), .y = p.y(), .z = p.z()}, t_ms);
  }
  void tell_odometry(std::uint32_t t_ms, std::uint8_t resets, std::uint8_t frame = 1) {
    const Eigen::Quaternionf q = turned_about_x(truth_.rotation(1e-3 * t_ms)).cast<float>();
    const Eigen::Vector3f p = turned_about_x(truth_.position(1e-3 * t_ms)).cast<float>();
    Odometry message{.time_usec = 1000ULL * t_ms, .x = p.x(), .y = p.y(), .z = p.z()};
    message.q = {q.w(), q.x(), q.y(), q.z()};
    message.frame_id = frame;
    message.child_frame_id = 12;
    message.reset_counter = resets;
    hear(message, t_ms);
  }
  /// Every pose is where the body was at its stamp.
  void expect_true_poses() const {
    for (const PoseSample& pose : taker.poses) {
      const double t_s = seconds(pose.stamp - kUnixAtStart);
      EXPECT_LT((pose.t_world_body_m - truth_.position(t_s)).norm(), 1e-5);
      EXPECT_LT(pose.R_world_body.angularDistance(truth_.rotation(t_s)), 1e-3);
      EXPECT_EQ(pose.clock, ClockDomain::kGlobal);
      EXPECT_EQ(pose.confidence, 3);
    }
  }

  bool knows_clock = true;
  KeepingTaker taker;
  VehiclePoses poses{&taker};

 private:
  template <class Message>
  void hear(const Message& message, std::uint32_t t_ms) {
    const Nanoseconds late = 7ms;  // the message's way, which must not matter
    const Nanoseconds t = std::chrono::milliseconds(t_ms) + late;
    const PoseClocks clocks{.now = HostTime(kOffset + t),
                            .unix_now = kUnixAtStart + t,
                            .offset = knows_clock ? std::optional(kOffset) : std::nullopt};
    PacketParser parser;
    parser.feed(PacketWriter({1, 1}).write(message, {}).bytes(), {},
                [&](const Packet& packet) { poses.hear(packet, clocks); });
  }
  Truth truth_;
};

TEST(VehiclePoses, are_where_the_body_was_at_their_stamp_whatever_the_order_of_messages) {
  test::for_each_seed(50, [](test::Random& random) {
    ToldVehicle vehicle({random.vector(-3, 3), random.vector(-1, 1)});
    std::uint32_t attitude_ms = 0, position_ms = 3;
    while (attitude_ms < 1000) {  // attitudes at 100 Hz, positions at 30 Hz, one or the other late
      if (position_ms + random.integer(0U, 15U) < attitude_ms) {
        vehicle.tell_position(position_ms);
        position_ms += 33;
      } else {
        vehicle.tell_attitude(attitude_ms);
        attitude_ms += 10;
      }
    }
    vehicle.expect_true_poses();
    EXPECT_GT(vehicle.taker.poses.size(), 10U) << random.repeat();
  });
}

TEST(VehiclePoses, of_odometry_come_alone_and_begin_anew_when_the_autopilot_says_so) {
  ToldVehicle vehicle({{1, 2, 0.5}, {0, 0, 0.3}});
  for (std::uint32_t t = 0; t < 500; t += 20) {
    vehicle.tell_odometry(t, t < 300 ? 4 : 5);
    vehicle.tell_attitude(t);
    vehicle.tell_position(t);
  }
  vehicle.expect_true_poses();
  EXPECT_EQ(vehicle.taker.poses.size(), 25U);
  EXPECT_EQ(vehicle.taker.resets, 1);
  vehicle.tell_odometry(500, 5, 8);  // of the body: it tells no place
  EXPECT_EQ(vehicle.taker.poses.size(), 25U);
}

TEST(VehiclePoses, wait_until_the_clocks_are_known_against_each_other) {
  ToldVehicle vehicle({{1, 0, 0}, {0, 0, 1}});
  vehicle.knows_clock = false;
  vehicle.tell_odometry(10, 0);
  EXPECT_TRUE(vehicle.taker.poses.empty());
  EXPECT_EQ(vehicle.poses.unsynchronised(), 1U);
}

TEST(VehiclePoses, are_not_made_across_a_gap_of_the_attitude) {
  ToldVehicle vehicle({{1, 0, 0}, {0, 0, 1}});
  vehicle.tell_attitude(0);
  vehicle.tell_position(100);
  vehicle.tell_attitude(300);
  EXPECT_TRUE(vehicle.taker.poses.empty());
}

}  // namespace
}  // namespace swiftlet::mavlink
