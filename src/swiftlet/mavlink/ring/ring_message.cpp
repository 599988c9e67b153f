// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/ring/ring_message.hpp"

#include <algorithm>
#include <cmath>

#include "swiftlet/mavlink/wire/codes.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr double kMost_cm = 65'533;  // max + 1 must not be "unknown"

std::uint16_t whole_cm(double distance_m) {
  return static_cast<std::uint16_t>(std::clamp(std::floor(distance_m * 100), 1.0, kMost_cm));
}

std::uint16_t tell_sector(const SectorView& view, const RingTelling& telling, RingReader reader,
                          std::uint16_t max_cm) {
  const bool is_seen = view.occupied_m <= telling.max_m;
  const bool ends_near = view.unknown_m < std::min(telling.least_known_m, view.occupied_m);
  if (ends_near && reader == RingReader::kArduPilot && is_seen) return whole_cm(view.occupied_m);
  if (ends_near) return kSectorUnknown;
  const double first_m = std::min(view.occupied_m, view.unknown_m);
  if (first_m > telling.max_m) return static_cast<std::uint16_t>(max_cm + 1);
  return std::min(whole_cm(first_m), max_cm);
}

/// What a reader of even sectors alone must be told there.
std::uint16_t widened(std::uint16_t own, std::uint16_t left, std::uint16_t right,
                      std::uint16_t max_cm) {
  if (own == kSectorUnknown) return own;
  const std::uint16_t nearest = std::min({own, left, right});
  if (nearest <= max_cm) return nearest;
  return std::max({own, left, right});  // free, unless a neighbour is unknown
}

}  // namespace

std::array<std::uint16_t, kSectors> tell_ring(const ObstacleRing& ring, const RingTelling& telling,
                                              RingReader reader) {
  const std::uint16_t max_cm = whole_cm(telling.max_m);
  std::array<std::uint16_t, kSectors> told{};
  std::ranges::transform(ring.sectors, told.begin(), [&](const SectorView& view) {
    return tell_sector(view, telling, reader, max_cm);
  });
  if (reader == RingReader::kArduPilot) return told;
  for (std::size_t i = 0; i < kSectors; i += 2) {
    told[i] = widened(told[i], told[(i + kSectors - 1) % kSectors], told[i + 1], max_cm);
  }
  return told;
}

ObstacleDistance obstacle_distance(const ObstacleRing& ring, const RingTelling& telling,
                                   RingReader reader, std::uint64_t time_usec) {
  ObstacleDistance message;
  message.time_usec = time_usec;
  message.distances = tell_ring(ring, telling, reader);
  // PX4 keeps the larger of this and CP_DIST away, and forgets no larger one: always 0.
  message.min_distance = 0;
  message.max_distance = whole_cm(telling.max_m);
  message.sensor_type = codes::kSensorUnknown;
  message.increment = 360 / kSectors;
  message.frame = codes::kFrameBodyFrd;
  return message;
}

}  // namespace swiftlet::mavlink
