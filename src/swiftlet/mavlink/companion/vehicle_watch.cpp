// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/vehicle_watch.hpp"

#include "swiftlet/mavlink/wire/system_messages.hpp"

namespace swiftlet::mavlink {

bool VehicleWatch::is_candidate(const Packet& packet) const {
  const auto heartbeat = packet.as<Heartbeat>();
  if (!heartbeat || heartbeat->autopilot == codes::kAutopilotNone) return false;
  if (packet.from.component != codes::kComponentAutopilot) return false;
  return wanted_system_ == 0 || packet.from.system == wanted_system_;
}

bool VehicleWatch::hear(std::size_t link, const Packet& packet, HostTime now) {
  const bool is_known = vehicle_ && packet.from == vehicle_->address;
  if (!is_known) {
    const bool is_free = !vehicle_ || now - vehicle_->heard_at > kSilence;
    if (!is_free || !is_candidate(packet)) return false;
    vehicle_.emplace();
    vehicle_->address = packet.from;
    clock_ = {};
  }
  if (const auto heartbeat = packet.as<Heartbeat>()) {
    vehicle_->link = link;
    vehicle_->autopilot = heartbeat->autopilot;
    vehicle_->type = heartbeat->type;
    vehicle_->is_armed = (heartbeat->base_mode & codes::kModeIsArmed) != 0;
    vehicle_->custom_mode = heartbeat->custom_mode;
    vehicle_->heard_at = now;
  }
  return true;
}

void VehicleWatch::note_clock(Stamp asked, Stamp theirs, Stamp answered) {
  clock_.add(asked, theirs, answered);
  if (!vehicle_) return;
  vehicle_->clock_offset = clock_.ours_minus_theirs();
  vehicle_->clock_round_trip = clock_.round_trip();
}

}  // namespace swiftlet::mavlink
