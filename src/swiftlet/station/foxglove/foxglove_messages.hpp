// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "swiftlet/station/map_model.hpp"

namespace swiftlet::station {

/// What a channel of the Foxglove protocol carries: one file of functions and one line a channel.
struct FoxgloveChannel {
  std::string_view topic;
  std::string_view schema;  ///< "foxglove_msgs/PointCloud" as CDR, or empty: JSON
  /// What makes a new message due.
  enum class Follows : std::uint8_t { kMap, kFrames, kDepth } follows;
  double max_hz;
  /// The newest state; empty where there is none yet.
  Bytes (*message)(const MapModel& model);
};

/// Their numbers on the wire are their places here, from 1.
[[nodiscard]] std::span<const FoxgloveChannel> foxglove_channels();

}  // namespace swiftlet::station
