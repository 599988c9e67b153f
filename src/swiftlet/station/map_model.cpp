// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/map_model.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet::station {
namespace {

BlockIndex middle_of(const MapMirror& map) {
  std::int64_t x = 0, y = 0, z = 0, count = 0;
  map.for_each_known_block([&](const BlockIndex& b, const VoxelBlock&) {
    x += b.x;
    y += b.y;
    z += b.z;
    ++count;
  });
  if (count == 0) return {};
  const auto mean = [count](std::int64_t sum) { return static_cast<std::int32_t>(sum / count); };
  return {mean(x), mean(y), mean(z)};
}

}  // namespace

MapModel::MapModel(MapInfo info, MapMirror map)
    : world_(1), info_(std::move(info)), map_(std::move(map)), centre_(middle_of(map_)) {}

MapModel::Update MapModel::poll() {
  Update update;
  if (feed_ == nullptr) return update;
  if (auto begun = feed_->world_after(world_)) {
    update.is_new_world = true;
    world_ = begun->number;
    info_ = std::move(begun->info);
    reader_ = std::move(begun->reader);
    map_ = MapMirror(info_.header);
    last_frame_.reset();
    course_.reset();
    verdicts_.assign(info_.verdicts.size(), 0);
  }
  for (const auto& gone : feed_->take_evicted()) map_.put(gone.index, gone.block, gone.version);
  for (const FrameReport& frame : std::exchange(early_, {})) book(frame, update);
  feed_->take_reports([&](const FrameReport& frame) { book(frame, update); });
  update.has_depth = feed_->take_depth(depth_);
  if (auto course = feed_->take_course()) {
    course_ = std::move(course);
    update.has_course = true;
  }
  if (reader_) {
    if (const auto snapshot = reader_->latest(); snapshot && snapshot->frame_count() > 0) {
      map_.update(*snapshot);
    }
  }
  update.changed = map_.take_changes();
  return update;
}

void MapModel::book(const FrameReport& frame, Update& update) {
  if (frame.world > world_) early_.push_back(frame);
  if (frame.world != world_) return;
  update.frames.push_back(frame);
  if (frame.verdict < verdicts_.size()) ++verdicts_[frame.verdict];
  last_frame_ = frame;
  const Eigen::Vector3d& p_world = frame.T_world_camera.translation();
  if (frame.has_shifted) trigger_centre_m_ = frame.window_goal.value_or(p_world);
  // Frames that were refused may be beyond.
  if (p_world.cwiseAbs().maxCoeff() < RollingMap::kMaxCoordinate_m) {
    centre_ = block_of(voxel_containing(p_world, map_.voxel_m()));
  }
}

FlightState MapModel::state() const {
  if (feed_ == nullptr) return FlightState::kSaved;
  if (feed_->is_over()) return FlightState::kOver;
  return map_.frame_count() > 0 ? FlightState::kFlying : FlightState::kWaiting;
}

StatusReport MapModel::status() const {
  StatusReport status;
  status.state = state();
  status.window = map_.window();
  status.trigger_centre_m = trigger_centre_m_;
  status.frame_count = map_.frame_count();
  status.blocks = map_.digest().blocks;
  status.verdicts = verdicts_;
  status.losses.resize(std::min(info_.losses.size(), kMaxLosses));
  if (last_frame_) status.memory_bytes = last_frame_->memory_bytes;
  if (feed_ != nullptr) {
    std::ranges::copy_n(feed_->losses().begin(), static_cast<std::ptrdiff_t>(status.losses.size()),
                        status.losses.begin());
    status.reports_missed = static_cast<std::uint32_t>(feed_->reports_missed());
  }
  return status;
}

}  // namespace swiftlet::station
