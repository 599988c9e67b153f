// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/map/block_archive.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/plan/course.hpp"
#include "swiftlet/station/state/map_info.hpp"
#include "swiftlet/station/state/report_ring.hpp"

namespace swiftlet::station {

/// What the mapping thread tells the station of: where the map is, each frame, and blocks that
/// leave the window.
///
/// Thread safety: begin_world() to finish() from the mapping thread, the others from the station's.
/// Real time: report() and lost() neither lock nor allocate; evicted(), which is
/// called in frames that move the window, copies 512 bytes under a lock that the station holds only
/// to exchange two buffers. begin_world() allocates; a flight calls it once, before its first
/// frame, and again when the map is begun anew.
class LiveFeed {
 public:
  static constexpr std::size_t kReports = 4096;  ///< 20 s of a fast flight
  static constexpr std::size_t kEvicted = 16384;

  LiveFeed();

  // The mapping thread.
  void begin_world(MapReader reader, const MapInfo& info);
  void report(FrameReport report);
  void evicted(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version);
  /// Keeps the image if somebody wants to see it and the station is not just taking one. Copies
  /// it then, and allocates where it is larger than all before.
  void depth(const DepthImage& image);
  /// What the planner is at. Copies it under a lock that the station holds only to exchange it.
  void course(const Course& course);
  /// Frames that the source has lost so far; also while none comes out of it.
  void lost(const std::array<std::uint32_t, kMaxLosses>& counts);
  void finish() { is_over_.store(true); }

  // The station's thread.
  struct EvictedBlock {
    BlockIndex index;
    std::uint64_t version = 0;
    VoxelBlock block;
  };
  struct World {
    std::uint32_t number = 0;  ///< 0: none has begun
    MapInfo info;
    std::optional<MapReader> reader;
  };
  /// The world that has begun since `number`; nullopt if there is no newer one. Then what is still
  /// in the feed of an older world is gone.
  [[nodiscard]] std::optional<World> world_after(std::uint32_t number);
  /// Calls visit(const FrameReport&) for all that have come.
  template <class Visit>
  void take_reports(Visit&& visit) {
    reports_.drain(visit);
  }
  /// What has left the window since the last call, in this order. Valid until the next call.
  [[nodiscard]] const std::vector<EvictedBlock>& take_evicted();
  void ask_for_depth() { wants_depth_.store(true); }
  /// The image that was asked for; false if there is none yet.
  [[nodiscard]] bool take_depth(DepthImage& out);
  /// The newest course; nullopt if it was taken already.
  [[nodiscard]] std::optional<Course> take_course();
  [[nodiscard]] std::array<std::uint32_t, kMaxLosses> losses() const;
  [[nodiscard]] std::uint64_t reports_missed() const { return reports_.missed(); }
  [[nodiscard]] std::uint64_t evicted_missed() const { return evicted_missed_.load(); }
  [[nodiscard]] bool is_over() const { return is_over_.load(); }

 private:
  ReportRing reports_{kReports};
  std::atomic<std::uint32_t> world_{0};
  std::atomic<bool> is_over_{false};
  std::array<std::atomic<std::uint32_t>, kMaxLosses> losses_{};
  std::atomic<std::uint64_t> evicted_missed_{0};

  std::mutex mutex_;
  // Guarded by mutex_.
  std::vector<EvictedBlock> filling_;
  std::optional<World> begun_;
  std::optional<Course> course_;

  std::atomic<bool> wants_depth_{false};
  std::mutex depth_mutex_;
  DepthImage depth_;            // guarded by depth_mutex_
  bool has_new_depth_ = false;  // guarded by depth_mutex_

  std::vector<EvictedBlock> taken_;  // the station's own
};

}  // namespace swiftlet::station
