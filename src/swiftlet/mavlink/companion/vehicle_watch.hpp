// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <optional>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/mavlink/companion/clock_offset.hpp"
#include "swiftlet/mavlink/wire/codes.hpp"
#include "swiftlet/mavlink/wire/packet.hpp"

namespace swiftlet::mavlink {

/// What an autopilot tells of itself.
struct VehicleState {
  Address address{};
  std::size_t link = 0;        ///< on which it was heard last
  std::uint8_t autopilot = 0;  ///< MAV_AUTOPILOT
  std::uint8_t type = 0;       ///< MAV_TYPE
  bool is_armed = false;
  std::uint32_t custom_mode = 0;
  HostTime heard_at{};                        ///< its last heartbeat
  std::optional<Nanoseconds> clock_offset{};  ///< our clock minus its, if it answers
  std::optional<Nanoseconds> clock_round_trip{};

  [[nodiscard]] bool is_ardupilot() const { return autopilot == codes::kAutopilotArduPilot; }
  [[nodiscard]] bool is_px4() const { return autopilot == codes::kAutopilotPx4; }
};

/// Follows the one autopilot that is spoken with: the first that is heard, or that of a chosen
/// system. Others, ground stations and companions among them, are not listened to; only when it has
/// been silent for kSilence may another take its place.
class VehicleWatch {
 public:
  static constexpr Nanoseconds kSilence = std::chrono::seconds(5);

  /// `system` 0: the first that is heard.
  explicit VehicleWatch(std::uint8_t system) : wanted_system_(system) {}

  /// Whether the packet is the autopilot's. Heartbeats are taken note of.
  bool hear(std::size_t link, const Packet& packet, HostTime now);
  /// The answer to a question for its clock.
  void note_clock(Stamp asked, Stamp theirs, Stamp answered);

  /// The autopilot, from its first heartbeat on, even if it is silent now.
  [[nodiscard]] const std::optional<VehicleState>& vehicle() const { return vehicle_; }

 private:
  [[nodiscard]] bool is_candidate(const Packet& packet) const;

  std::uint8_t wanted_system_;
  std::optional<VehicleState> vehicle_;
  ClockOffset clock_;
};

}  // namespace swiftlet::mavlink
