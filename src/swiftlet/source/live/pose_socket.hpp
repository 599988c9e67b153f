// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/source/live/device_supervisor.hpp"
#include "swiftlet/source/rig/mounts.hpp"

namespace swiftlet {

/// Where poses come to: a UDP port, or a datagram socket in the file system.
struct PoseAddress {
  std::string host = "127.0.0.1";    ///< IPv4; of the interface that listens
  std::uint16_t port = 0;            ///< 0: the socket of the next line
  std::filesystem::path socket{};    ///< for programs of the same user on this computer
  std::filesystem::path key_file{};  ///< of the shared key; empty: anyone is believed
  /// Of the autopilot that the program speaks with: nothing is listened to here, whoever speaks
  /// with it pushes into FrameSource::pose_sink().
  bool is_autopilot = false;

  /// "poses on UDP port 5605"
  [[nodiscard]] std::string title() const;
};
/// Reads "udp:PORT", "udp:ADDRESS:PORT", "unix:PATH" or "mavlink"; nullopt for anything else.
[[nodiscard]] std::optional<PoseAddress> parse_pose_address(std::string_view text);

/// Receives poses as text: a datagram holds one or more pose lines (see parse_pose_line()), and
/// with a key two more (see PoseGuard); lines that start with # say nothing. What cannot be read,
/// is forged or comes again is told as events (kBadPose, kForgedPose, kReplayedPose), each kind at
/// most once a second with how many there were; so is a port that others than this computer reach
/// without a key (kOpenPort). Its own thread delivers into the sink, which outlives it.
///
/// Errors: kIo if the port is taken or not allowed; kOutOfMemory if the system starts no thread;
/// those of load_pose_key().
[[nodiscard]] Expected<LiveStreamPtr> listen_for_poses(const PoseAddress& address, BodyAxes axes,
                                                       LiveSink& sink);
/// On a UDP port of the loopback address, without a key.
[[nodiscard]] Expected<LiveStreamPtr> listen_for_poses(std::uint16_t port, BodyAxes axes,
                                                       LiveSink& sink);

}  // namespace swiftlet
