// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "swiftlet/station/page/wire.hpp"
#include "swiftlet/station/state/live_feed.hpp"
#include "swiftlet/station/state/map_mirror.hpp"

namespace swiftlet::station {

/// What the station knows: the map, the flight, and how both stand. Looks at them when it is told
/// to and says what has changed since.
/// Thread safety: the station's thread alone.
class MapModel {
 public:
  /// Watches a flight. The feed must outlive this.
  explicit MapModel(LiveFeed& feed) : feed_(&feed) {}
  /// Shows a saved map.
  MapModel(MapInfo info, MapMirror map);

  /// What is new since the last poll.
  struct Update {
    bool is_new_world = false;
    std::vector<BlockIndex> changed;
    std::vector<FrameReport> frames;
    bool has_depth = false;   ///< depth() is new
    bool has_course = false;  ///< course() is new
  };
  [[nodiscard]] Update poll();

  [[nodiscard]] std::uint32_t world() const { return world_; }  ///< 0: none has begun
  [[nodiscard]] const MapInfo& info() const { return info_; }
  [[nodiscard]] const MapMirror& map() const { return map_; }
  [[nodiscard]] FlightState state() const;
  [[nodiscard]] const std::optional<FrameReport>& last_frame() const { return last_frame_; }
  /// The block where the vehicle is, or the middle of a saved map.
  [[nodiscard]] const BlockIndex& centre() const { return centre_; }
  /// The newest depth image that was asked for; empty before the first.
  [[nodiscard]] const DepthImage& depth() const { return depth_; }
  /// What the planner of this flight is at; nullopt if none has told.
  [[nodiscard]] const std::optional<Course>& course() const { return course_; }
  /// Asks for the depth image of the next frame.
  void ask_for_depth() {
    if (feed_ != nullptr) feed_->ask_for_depth();
  }
  /// How things stand, but for what concerns one client.
  [[nodiscard]] StatusReport status() const;

 private:
  void book(const FrameReport& frame, Update& update);

  LiveFeed* feed_ = nullptr;  // null: a saved map
  std::optional<MapReader> reader_;
  std::uint32_t world_ = 0;
  MapInfo info_;
  MapMirror map_;
  std::optional<FrameReport> last_frame_;
  std::vector<FrameReport> early_;  // of a world that poll() has not come to yet
  std::vector<std::uint32_t> verdicts_;
  DepthImage depth_;
  std::optional<Course> course_;
  Eigen::Vector3d trigger_centre_m_ = Eigen::Vector3d::Zero();
  BlockIndex centre_;
};

}  // namespace swiftlet::station
