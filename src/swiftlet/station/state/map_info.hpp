// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/map/map_header.hpp"

namespace swiftlet::station {

/// What a client must know of a map before its first voxel. Numbers in frames and counters stand
/// for the names here, so that a page shows reasons which it was not written for.
struct MapInfo {
  std::string source;   ///< where the frames or the map come from, for people
  std::string version;  ///< of the program
  bool is_live = false;
  MapHeader header{};
  Eigen::Vector3d trigger_m = Eigen::Vector3d::Zero();  ///< half extents of the trigger box
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  std::vector<std::string> stages;    ///< of FrameReport::stage_ms
  std::vector<std::string> verdicts;  ///< of FrameReport::verdict; the first one is good
  std::vector<std::string> losses;    ///< of FrameReport::lost
};

inline constexpr std::size_t kMaxStages = 4;
inline constexpr std::size_t kMaxLosses = 16;

/// What became of one frame: plain data, so that the mapping thread hands it over without
/// allocating.
struct FrameReport {
  Stamp stamp;
  std::uint32_t number = 0;  ///< of the frames offered to the mapper, from 1
  std::uint8_t verdict = 0;  ///< index into MapInfo::verdicts
  std::uint8_t camera = 0;   ///< which one of the rig
  bool has_shifted = false;  ///< the window moved
  /// Around which place, if not the camera's (map.lookahead_s).
  std::optional<Eigen::Vector3d> window_goal{};
  bool was_hidden = false;  ///< readers held every snapshot, so the map they see is older
  std::uint32_t world = 0;  ///< set by LiveFeed
  Transform<World, Camera> T_world_camera;
  std::array<float, kMaxStages> stage_ms{};
  std::uint32_t readings = 0;
  std::uint32_t voxels = 0;
  std::uint32_t blocks_left = 0;  ///< in view but not fused: the deadline was over
  std::optional<PinholeIntrinsics> intrinsics;
  std::array<std::uint32_t, kMaxLosses> lost{};  ///< so far, by MapInfo::losses
  std::uint64_t memory_bytes = 0;
};

}  // namespace swiftlet::station
