// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "swiftlet/mavlink/wire/command_messages.hpp"
#include "swiftlet/mavlink/wire/motion_messages.hpp"
#include "swiftlet/mavlink/wire/obstacle_messages.hpp"
#include "swiftlet/mavlink/wire/system_messages.hpp"

namespace swiftlet::mavlink {

/// The messages that are spoken here, by rising number: a new one is a struct and a name in this
/// list.
using Messages = std::tuple<Heartbeat, SystemTime, ParamRequestRead, ParamValue, AttitudeQuaternion,
                            LocalPositionNed, CommandLong, CommandAck, VisionPositionEstimate,
                            VisionSpeedEstimate, HighresImu, Timesync, DistanceSensor, StatusText,
                            ObstacleDistance, Odometry, ObstacleDistance3d>;

/// What a receiver must know of a message to check its frame.
struct MessageKind {
  std::uint32_t id;
  std::string_view name;
  std::uint8_t crc_extra;
};

/// Null for a message that is not spoken here. Cost: a binary search.
[[nodiscard]] const MessageKind* find_message(std::uint32_t id);

/// Calls visit(Message{}) for each kind.
template <class Visit>
void for_each_message(Visit&& visit) {
  std::apply([&](const auto&... message) { (visit(message), ...); }, Messages{});
}

}  // namespace swiftlet::mavlink
