// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "swiftlet/app/view/station_flags.hpp"
#include "swiftlet/session/session_observer.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/station/state/live_feed.hpp"
#include "swiftlet/station/station.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet::app {

/// Shows a flight in the ground station while it goes on.
class FlightWatch final : public SessionObserver {
 public:
  /// Starts to serve; `meta` as in the map file. Errors: kUsage, kIo, kUnsupported (see
  /// Station::start()).
  [[nodiscard]] static Expected<std::unique_ptr<FlightWatch>> start(const StationFlags& flags,
                                                                    std::string source,
                                                                    MapMeta meta);

  void map_begun(const Mapper& mapper) override;
  void frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) override;
  void block_left(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override;

  /// What the source has lost so far, and blocks of the map that the disk has refused.
  void note(const FrameTally& tally, std::uint64_t blocks_lost);
  /// There will be no more frames.
  void finish() { feed_.finish(); }

  [[nodiscard]] const station::Station& station() const { return *station_; }

 private:
  explicit FlightWatch(std::string source) : source_(std::move(source)) {}

  std::string source_;
  station::FrameReport report_;  // filled anew for each frame
  std::uint32_t frames_ = 0;
  station::LiveFeed feed_;
  std::unique_ptr<station::Station> station_;  // last: it reads the feed
};

}  // namespace swiftlet::app
