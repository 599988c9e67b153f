// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>

#include "swiftlet/mavlink/ring/obstacle_ring.hpp"
#include "swiftlet/mavlink/wire/obstacle_messages.hpp"

namespace swiftlet::mavlink {

/// How whoever receives distances takes them.
enum class RingReader : std::uint8_t {
  kPx4,        ///< unknown stops; some versions read only every other sector
  kArduPilot,  ///< unknown looks like free; all sectors are read
};

struct RingTelling {
  double max_m = 12.0;  ///< as RingOptions::max_m
  /// A sector whose known part ends nearer than this, before anything solid, is told as unknown.
  /// One that is known further is told as if the end of the known were a wall: the vehicle may go
  /// there, and slows.
  double least_known_m = 2.0;
};

/// A whole number of centimetres, never more than the distance. A distance of 0 would mean "not
/// used" to both autopilots, so the least is 1.
inline constexpr std::uint16_t kSectorUnknown = 65'535;

/// The distances of OBSTACLE_DISTANCE [cm], max_m + 1 cm for free all the way, kSectorUnknown.
///
/// Laws: nothing solid nearer than what is told; never free where a part is unknown. For kPx4, each
/// even sector holds what is nearest in its neighbours, too, as versions with 36 bins read no other
/// (CollisionPrevention.cpp, BIN_COUNT 36); and a sector whose near part is unknown is told as
/// unknown whatever lies behind. For kArduPilot, to which it would then look free, the nearest
/// thing that is known is told.
[[nodiscard]] std::array<std::uint16_t, kSectors> tell_ring(const ObstacleRing& ring,
                                                            const RingTelling& telling,
                                                            RingReader reader);

/// The whole message: 72 sectors of 5 degrees, BODY_FRD, no offset, the one form that every known
/// version of both autopilots reads right.
[[nodiscard]] ObstacleDistance obstacle_distance(const ObstacleRing& ring,
                                                 const RingTelling& telling, RingReader reader,
                                                 std::uint64_t time_usec);

}  // namespace swiftlet::mavlink
