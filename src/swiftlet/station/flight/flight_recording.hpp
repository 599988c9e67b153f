// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "swiftlet/bag/mcap/mcap_writer.hpp"
#include "swiftlet/bag/messages/ros2_messages.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/station/map_model.hpp"

namespace swiftlet::station {

/// Writes a flight into an MCAP file while it goes on, as messages of ROS 2: each depth image with
/// its camera and pose, and once a second of the flight the occupied voxels, those that changed,
/// the path and the statistics. `bag:` maps the file again, and Foxglove, Lichtblick and Rerun show
/// it.
///
/// A thread of its own packs and writes. Where frames come from a live rig, those that it is late
/// for are left out and counted; a recording waits for it.
/// Thread safety: add() and close() by one thread, the one that maps.
class FlightRecording {
 public:
  /// The map comes through the feed, which must outlive this. `words` go into the file as they are.
  /// Errors: kIo, kOutOfMemory.
  [[nodiscard]] static Expected<std::unique_ptr<FlightRecording>> start(
      const std::filesystem::path& path, LiveFeed& feed, const McapWriter::Metadata& words);
  FlightRecording(const FlightRecording&) = delete;
  FlightRecording& operator=(const FlightRecording&) = delete;
  ~FlightRecording();

  /// A frame that was mapped.
  void add(const Frame& frame);

  /// Waits until all is written and the file is whole. Errors: kIo, the first.
  [[nodiscard]] Status close();
  /// Frames that were left out.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }

 private:
  FlightRecording(LiveFeed& feed, McapWriter writer);
  void run();
  [[nodiscard]] std::deque<Frame> take_frames();
  void poll_map();
  [[nodiscard]] Status write_all(std::deque<Frame>&& frames);
  [[nodiscard]] Status write_frame(const Frame& frame);
  [[nodiscard]] Status write_map();
  [[nodiscard]] Status write_voxels(Stamp now);
  [[nodiscard]] Status write(std::string_view topic, std::string_view type, Stamp time,
                             const Bytes& message);
  void note_path(const ros2::Placement& placement);
  [[nodiscard]] bool is_finished();

  McapWriter writer_;
  std::map<std::string, std::uint16_t, std::less<>> topics_;
  MapModel model_;
  std::vector<BlockIndex> changed_;    // since the last voxels were written
  std::vector<ros2::Placement> path_;  // thinned out as it grows
  std::size_t path_every_ = 1, path_seen_ = 0;
  std::uint32_t epoch_ = 0;  // Frame::pose_epoch of the path
  std::optional<Stamp> newest_, map_written_;
  Status outcome_ = Done{};
  std::uint64_t missed_ = 0;  // the mapping thread's

  std::mutex mutex_;
  std::condition_variable has_changed_;
  std::deque<Frame> frames_;  // guarded by mutex_
  bool is_closing_ = false;   // guarded by mutex_
  std::thread thread_;        // last: it uses all the others
};

}  // namespace swiftlet::station
