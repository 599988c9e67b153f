// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "swiftlet/mavlink/companion/flight_news.hpp"
#include "swiftlet/mavlink/companion/vehicle_poses.hpp"
#include "swiftlet/mavlink/companion/vehicle_watch.hpp"
#include "swiftlet/mavlink/links/link_thread.hpp"
#include "swiftlet/mavlink/ring/obstacle_ring.hpp"
#include "swiftlet/mavlink/ring/ring_message.hpp"

namespace swiftlet::mavlink {

/// Whether and how our poses are told to the autopilot.
enum class PoseTelling : std::uint8_t { kNone, kOdometry, kVisionPosition };

struct CompanionOptions {
  std::size_t links = 1;
  std::optional<SigningKey> key{};
  std::uint8_t system = 0;  ///< of the vehicle, which is ours too; 0: the first that is heard
  std::uint8_t component = codes::kComponentObstacleAvoidance;
  RingOptions ring{};
  double least_known_m = 2.0;  ///< as RingTelling
  PoseTelling poses = PoseTelling::kNone;
  /// Takes the vehicle's own poses, which it is then asked for; null: nobody wants them. It
  /// outlives the companion.
  PoseTaker* pose_taker = nullptr;
  Nanoseconds obstacle_period = std::chrono::milliseconds(66);  ///< 15 Hz
  /// When the newest frame in the map is this old, the map is no longer told: the autopilot must
  /// not fly by what may have changed.
  Nanoseconds stale_after = std::chrono::milliseconds(300);
};

/// How the map stands, as the autopilot is told.
enum class MapHealth : std::uint8_t {
  kNone,  ///< nothing is mapped yet
  kFresh,
  kStale,  ///< no frame has come into the map for `stale_after`
};

/// What the autopilot was last told, and what it told.
struct CompanionReport {
  MapHealth health = MapHealth::kNone;
  std::array<std::uint16_t, kSectors> told_cm{};  ///< as in OBSTACLE_DISTANCE
  std::uint16_t max_cm = 0;
  std::uint64_t rings_told = 0, poses_told = 0;
  Nanoseconds ring_age{};         ///< from the exposure of its newest frame to the message
  Nanoseconds ring_cost{};        ///< to look around
  std::uint64_t poses_heard = 0;  ///< given to the pose taker
  std::optional<VehicleState> vehicle{};
};

/// Speaks with an autopilot over links: tells what is in the way, where the vehicle is and how the
/// map stands, and answers for our clock. It knows no sockets, and all that happens happens at a
/// `now` that it is told; so a test is a table of times. (Signatures and costs alone are timed.)
///
/// Times on the wire are those of this computer's steady clock, which never jumps; autopilots that
/// ask for it (TIMESYNC) know it as theirs.
/// Thread safety: the links' thread alone.
class Companion {
 public:
  /// `news` must outlive it.
  Companion(const CompanionOptions& options, FlightNews& news);

  void received(std::size_t link, const Packet& packet, HostTime now, FrameOutlet& out);
  void tick(HostTime now, FrameOutlet& out);

  [[nodiscard]] const CompanionReport& report() const { return report_; }

 private:
  template <class Message>
  void tell_all(const Message& message, FrameOutlet& out);
  template <class Message>
  void tell_one(std::size_t link, const Message& message, FrameOutlet& out);

  void take_news(FrameOutlet& out);
  void tell_pose(const MappedFrame& frame, FrameOutlet& out);
  void judge_health(HostTime now, FrameOutlet& out);
  void tell_ring(HostTime now, FrameOutlet& out);
  void tell_heartbeat(FrameOutlet& out);
  void tell_pilot(Urgency urgency, std::string_view text, FrameOutlet& out);
  void ask_for_poses(HostTime now, FrameOutlet& out);
  void answer_clock(std::size_t link, const Packet& packet, HostTime now, FrameOutlet& out);

  /// When something that is repeated is due.
  struct Timer {
    std::optional<HostTime> last{};
    bool is_due(HostTime now, Nanoseconds period) {
      if (last && now - *last < period) return false;
      last = now;
      return true;
    }
  };

  CompanionOptions options_;
  FlightNews& news_;
  std::vector<PacketWriter> writers_;  // one a link
  VehicleWatch watch_;
  VehiclePoses vehicle_poses_;
  std::optional<MapReader> map_;
  std::optional<MappedFrame> frame_;
  bool is_frame_of_map_ = false;  // false while frame_ is older than map_
  std::uint8_t resets_ = 0;
  Timer heartbeat_, ring_, clock_, asking_;
  CompanionReport report_;
};

}  // namespace swiftlet::mavlink
