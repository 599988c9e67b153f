// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/companion.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/mavlink/companion/pose_message.hpp"
#include "swiftlet/mavlink/wire/command_messages.hpp"
#include "swiftlet/mavlink/wire/system_messages.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr Nanoseconds kHeartbeatPeriod = std::chrono::seconds(1);
constexpr Nanoseconds kClockPeriod = std::chrono::seconds(1);
constexpr Nanoseconds kAskingPeriod = std::chrono::seconds(2);
constexpr float kPosePeriod_us = 20'000;
/// A motion between two frames that lie further apart, or hardly apart, says nothing.
constexpr Nanoseconds kLongestStep = std::chrono::milliseconds(300);
constexpr Nanoseconds kShortestStep = std::chrono::milliseconds(2);

Stamp stamp_of(HostTime time) { return {Nanoseconds(time.time_since_epoch()).count()}; }

std::uint64_t usec(HostTime time) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count());
}

Stamp unix_time() {
  return {Nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
}

std::uint8_t state_of(MapHealth health) {
  switch (health) {
    case MapHealth::kNone:
      return codes::kStateStandby;
    case MapHealth::kFresh:
      return codes::kStateActive;
    case MapHealth::kStale:
      break;
  }
  return codes::kStateCritical;
}

}  // namespace

Companion::Companion(const CompanionOptions& options, FlightNews& news)
    : options_(options), news_(news), watch_(options.system), vehicle_poses_(options.pose_taker) {
  constexpr std::uint8_t kUsualSystem = 1;
  const Address self{options.system == 0 ? kUsualSystem : options.system, options.component};
  for (std::size_t link = 0; link < options.links; ++link) {
    const auto number = static_cast<std::uint8_t>(link);
    writers_.emplace_back(self,
                          options.key ? std::optional(Signer(*options.key, number)) : std::nullopt);
  }
}

template <class Message>
void Companion::tell_one(std::size_t link, const Message& message, FrameOutlet& out) {
  out.send(link, writers_[link].write(message, unix_time()));
}

template <class Message>
void Companion::tell_all(const Message& message, FrameOutlet& out) {
  for (std::size_t link = 0; link < writers_.size(); ++link) tell_one(link, message, out);
}

void Companion::received(std::size_t link, const Packet& packet, HostTime now, FrameOutlet& out) {
  const bool was_known = watch_.vehicle().has_value();
  if (!watch_.hear(link, packet, now)) return;
  if (!was_known) {
    const std::uint8_t system = watch_.vehicle()->address.system;
    for (PacketWriter& writer : writers_) writer.speak_as({system, options_.component});
  }
  answer_clock(link, packet, now, out);
  vehicle_poses_.hear(packet, {now, unix_time(), watch_.vehicle()->clock_offset});
  report_.vehicle = watch_.vehicle();
  report_.poses_heard = vehicle_poses_.given();
}

void Companion::answer_clock(std::size_t link, const Packet& packet, HostTime now,
                             FrameOutlet& out) {
  const auto message = packet.as<Timesync>();
  if (!message) return;
  if (message->tc1 == 0) {
    return tell_one(link,
                    Timesync{.tc1 = stamp_of(now).ns,
                             .ts1 = message->ts1,
                             .target_system = packet.from.system,
                             .target_component = packet.from.component},
                    out);
  }
  // An answer to somebody else's question is about times that are not ours; ClockOffset refuses it.
  watch_.note_clock({message->ts1}, {message->tc1}, stamp_of(now));
}

void Companion::tick(HostTime now, FrameOutlet& out) {
  take_news(out);
  judge_health(now, out);
  tell_ring(now, out);
  if (heartbeat_.is_due(now, kHeartbeatPeriod)) tell_heartbeat(out);
  if (watch_.vehicle() && clock_.is_due(now, kClockPeriod))
    tell_one(watch_.vehicle()->link, Timesync{.ts1 = stamp_of(now).ns}, out);
  ask_for_poses(now, out);
}

void Companion::ask_for_poses(HostTime now, FrameOutlet& out) {
  if (options_.pose_taker == nullptr || !watch_.vehicle() || vehicle_poses_.is_fed(now)) return;
  if (!asking_.is_due(now, kAskingPeriod)) return;
  const auto& vehicle = *watch_.vehicle();
  for (const std::uint32_t id : {Odometry::kId, AttitudeQuaternion::kId, LocalPositionNed::kId}) {
    tell_one(vehicle.link,
             CommandLong{.param1 = static_cast<float>(id),
                         .param2 = kPosePeriod_us,
                         .command = codes::kSetMessageInterval,
                         .target_system = vehicle.address.system,
                         .target_component = vehicle.address.component},
             out);
  }
}

void Companion::take_news(FrameOutlet& out) {
  if (auto map = news_.take_map()) {
    map_ = std::move(map);
    is_frame_of_map_ = false;
  }
  for (const auto& sentence : news_.take_sentences())
    tell_pilot(sentence.urgency, sentence.text, out);
  const auto frame = news_.take_frame();
  if (!frame) return;
  if (frame_ && frame->pose_epoch != frame_->pose_epoch) {
    ++resets_;
    tell_pilot(Urgency::kCritical, "mapper: pose was lost, a new map begins", out);
  }
  tell_pose(*frame, out);
  frame_ = frame;
  is_frame_of_map_ = true;
}

void Companion::tell_pose(const MappedFrame& frame, FrameOutlet& out) {
  if (options_.poses == PoseTelling::kNone) return;
  if (options_.poses == PoseTelling::kVisionPosition) {
    tell_all(vision_position_of(frame, usec(frame.taken_at), resets_), out);
  } else {
    if (!frame_ || frame_->pose_epoch != frame.pose_epoch) return;  // it has no motion yet
    const Nanoseconds step = frame.taken_at - frame_->taken_at;
    if (step < kShortestStep || step > kLongestStep) return;
    tell_all(odometry_of(frame, motion_between(*frame_, frame), usec(frame.taken_at), resets_),
             out);
  }
  ++report_.poses_told;
}

void Companion::judge_health(HostTime now, FrameOutlet& out) {
  if (!frame_ || !map_) return;
  const MapHealth health =
      now - frame_->taken_at > options_.stale_after ? MapHealth::kStale : MapHealth::kFresh;
  const MapHealth before = std::exchange(report_.health, health);
  if (health == before) return;
  heartbeat_.last.reset();  // it is told at once
  if (health == MapHealth::kStale)
    tell_pilot(Urgency::kCritical, "mapper: no new frames, obstacles not told", out);
  if (health == MapHealth::kFresh && before == MapHealth::kStale)
    tell_pilot(Urgency::kInfo, "mapper: frames again, obstacles told", out);
}

void Companion::tell_ring(HostTime now, FrameOutlet& out) {
  if (report_.health != MapHealth::kFresh || !is_frame_of_map_) return;
  if (!ring_.is_due(now, options_.obstacle_period)) return;
  const auto map = map_->latest();
  if (!map) return;
  const HostTime begin = HostTime::clock::now();
  const ObstacleRing ring = look_around(*map, frame_->T_world_body, options_.ring);
  report_.ring_cost = HostTime::clock::now() - begin;
  const auto& vehicle = watch_.vehicle();
  const RingReader reader =
      vehicle && vehicle->is_ardupilot() ? RingReader::kArduPilot : RingReader::kPx4;
  const RingTelling telling{.max_m = options_.ring.max_m, .least_known_m = options_.least_known_m};
  const ObstacleDistance message = obstacle_distance(ring, telling, reader, usec(frame_->taken_at));
  tell_all(message, out);
  report_.told_cm = message.distances;
  report_.max_cm = message.max_distance;
  report_.ring_age = now + report_.ring_cost - frame_->taken_at;
  ++report_.rings_told;
}

void Companion::tell_heartbeat(FrameOutlet& out) {
  tell_all(Heartbeat{.type = codes::kTypeOnboardController,
                     .autopilot = codes::kAutopilotNone,
                     .system_status = state_of(report_.health)},
           out);
}

void Companion::tell_pilot(Urgency urgency, std::string_view text, FrameOutlet& out) {
  StatusText message;
  message.severity = static_cast<std::uint8_t>(urgency);
  std::ranges::copy(text.substr(0, message.text.size()), message.text.begin());
  tell_all(message, out);
}

}  // namespace swiftlet::mavlink
