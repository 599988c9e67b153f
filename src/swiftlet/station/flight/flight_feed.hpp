// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "swiftlet/session/session_observer.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/station/state/live_feed.hpp"

namespace swiftlet::station {

/// Tells a flight, while it goes on, to a thread that follows its map.
class FlightFeed : public SessionObserver {
 public:
  void map_begun(const Mapper& mapper) override;
  void frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) override;
  void block_left(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override;

  /// What the source has lost so far, and blocks of the map that the disk has refused.
  void note(const FrameTally& tally, std::uint64_t blocks_lost);
  /// What the planner is at, if the flight has one. From the thread of frame_done().
  void note(const Course& course) { feed_.course(course); }
  /// There will be no more frames.
  void finish() { feed_.finish(); }

 protected:
  explicit FlightFeed(std::string source) : source_(std::move(source)) {}
  [[nodiscard]] LiveFeed& feed() { return feed_; }

 private:
  std::string source_;
  FrameReport report_;  // filled anew for each frame
  std::uint32_t frames_ = 0;
  LiveFeed feed_;
};

}  // namespace swiftlet::station
