// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/source/live_keeper.hpp"
#include "swiftlet/source/mounts.hpp"

namespace swiftlet {

/// Receives poses as text over UDP on the loopback address: a datagram holds one or more pose lines
/// (see parse_pose_line()); lines that start with # say nothing. What cannot be read is told as an
/// event (kBadPose), at most once a second. Its own thread delivers into the sink, which outlives
/// it. Whoever wants poses from another machine forwards them, as with an ssh tunnel or a bridge.
///
/// Errors: kIo if the port is taken or not allowed.
[[nodiscard]] Expected<LiveStreamPtr> listen_for_poses(std::uint16_t port, BodyAxes axes,
                                                       LiveSink& sink);

}  // namespace swiftlet
