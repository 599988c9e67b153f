// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/flight/flight_feed.hpp"

#include <algorithm>

namespace swiftlet::station {

void FlightFeed::map_begun(const Mapper& mapper) {
  const MapperConfig& config = mapper.config();
  MapInfo info;
  info.source = source_;
  info.version = SWIFTLET_VERSION;
  info.is_live = true;
  info.header.voxel_m = config.map.voxel_m;
  info.header.scale = config.scale();
  info.trigger_m = config.map.trigger_m;
  info.min_range_m = config.depth.min_range_m;
  info.max_range_m = config.depth.max_range_m;
  info.stages.assign(kStageNames.begin(), kStageNames.end());
  info.verdicts.assign(kFrameVerdictNames.begin(), kFrameVerdictNames.end());
  info.losses.assign(kFrameLossNames.begin(), kFrameLossNames.end());
  info.losses.emplace_back("map_blocks");  // see note()
  feed_.begin_world(mapper.reader(), info);
}

void FlightFeed::frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) {
  static_assert(kStageNames.size() == kMaxStages);
  static_assert(kFrameLossNames.size() < kMaxLosses);
  report_.stamp = frame.stamp;
  report_.number = ++frames_;
  report_.verdict = static_cast<std::uint8_t>(update.verdict);
  report_.camera = frame.camera;
  report_.has_shifted = update.shift.moved;
  report_.window_goal = update.window_goal;
  report_.was_hidden = !update.was_published;
  report_.T_world_camera = frame.T_world_camera;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    report_.stage_ms[i] = static_cast<float>(seconds(update.times.of[i]) * 1e3);
  }
  report_.readings = static_cast<std::uint32_t>(update.tally.readings);
  report_.voxels = static_cast<std::uint32_t>(update.tally.voxels);
  report_.blocks_left = static_cast<std::uint32_t>(update.tally.blocks_left);
  report_.intrinsics = frame.intrinsics;
  report_.memory_bytes = mapper.memory_bytes();
  feed_.report(report_);
  feed_.depth(frame.depth);
}

void FlightFeed::block_left(const BlockIndex& index, const VoxelBlock& block,
                            std::uint64_t version) {
  feed_.evicted(index, block, version);
}

void FlightFeed::note(const FrameTally& tally, std::uint64_t blocks_lost) {
  std::ranges::transform(tally.lost, report_.lost.begin(),
                         [](std::size_t n) { return static_cast<std::uint32_t>(n); });
  auto all = report_.lost;  // a frame's report counts frames only
  all[kFrameLossNames.size()] = static_cast<std::uint32_t>(blocks_lost);
  feed_.lost(all);
}

}  // namespace swiftlet::station
