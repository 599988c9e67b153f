// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/mapping_session.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "swiftlet/store/map_file.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::app {

Expected<std::unique_ptr<MappingSession>> MappingSession::create(const MapperConfig& config,
                                                                 const SessionOptions& options) {
  std::unique_ptr<MappingSession> session(new MappingSession(options));
  if (auto begun = session->begin_map(config); !begun) return forward_error(std::move(begun));
  return session;
}

Status MappingSession::begin_map(const MapperConfig& config) {
  auto mapper = Mapper::create(config, &archive_);
  if (!mapper) return forward_error(std::move(mapper));
  mapper_ = std::make_unique<Mapper>(std::move(*mapper));
  if (options_.observer != nullptr) options_.observer->map_begun(*mapper_);
  return Done{};
}

void MappingSession::book(const Frame& frame, const MapUpdate& update) {
  ++summary_.verdicts[static_cast<std::size_t>(update.verdict)];
  if (update.verdict != FrameVerdict::kIntegrated) return;
  summary_.latency.add(update.times);
  if (frame.seen_at) summary_.latency.add_age(HostTime::clock::now() - *frame.seen_at);
  summary_.late_frames += update.tally.blocks_left > 0 ? 1 : 0;
  summary_.blocks_left += update.tally.blocks_left;
  summary_.blocks_evicted += update.shift.blocks_evicted;
  summary_.blocks_restored += update.shift.blocks_restored;
  summary_.memory_bytes = mapper_->memory_bytes();
}

Status MappingSession::set_old_map_aside() {
  std::error_code unreadable;
  if (!options_.store.overwrite || !std::filesystem::is_regular_file(options_.path, unreadable)) {
    return Done{};
  }
  auto renamed = MapFile::rename(options_.path, path_aside(options_.path));
  is_old_map_aside_ = renamed.has_value();
  return renamed;
}

Status MappingSession::create_file(const Eigen::Vector3d& start_m) {
  options_.meta["start_m"] = fmt::format("{} {} {}", start_m.x(), start_m.y(), start_m.z());
  if (auto aside = set_old_map_aside(); !aside) return aside;
  auto store =
      TileStore::create(options_.path, mapper_->map().voxel_m(), options_.store, options_.meta);
  if (!store) {
    if (is_old_map_aside_) (void)MapFile::rename(path_aside(options_.path), options_.path);
    return forward_error(std::move(store));
  }
  store_ = std::move(*store);
  store_->follow(mapper_->reader());
  archive_.attach(*store_);
  return Done{};
}

/// The tracker has lost its place: what was mapped lies anywhere, seen from now on.
Status MappingSession::start_again() {
  ++summary_.restarts;
  archive_.detach();
  store_.reset();
  options_.store.overwrite = true;  // the file is ours by now
  return begin_map(MapperConfig(mapper_->config()));
}

Status MappingSession::integrate(const Frame& frame) {
  const bool is_new_world = frame.pose_epoch != pose_epoch_;
  pose_epoch_ = frame.pose_epoch;
  if (is_new_world && has_map()) {
    if (auto started = start_again(); !started) return started;
  }
  const MapUpdate update = mapper_->integrate(frame);
  book(frame, update);
  if (options_.observer != nullptr) options_.observer->frame_done(frame, update, *mapper_);
  if (update.verdict != FrameVerdict::kIntegrated) return Done{};
  if (store_ == nullptr) return create_file(frame.T_world_camera.translation());
  if (!update.shift.moved) return Done{};
  const TileStoreStats stats = store_->stats();
  if (stats.lost == 0) return Done{};
  if (stats.error) return tl::make_unexpected(*stats.error);
  return fail(ErrorCode::kIo, options_.path, fmt::format("{} blocks were lost", stats.lost),
              "write to a faster disk with room");
}

Status MappingSession::save() {
  // No snapshot (readers hold all of them): the store writes the newest that was published.
  if (auto closed = store_->close(mapper_->snapshot()); !closed) return closed;
  auto file = read_back();
  if (!file) return forward_error(std::move(file));
  summary_.file = std::move(*file);
  if (is_old_map_aside_) MapFile::remove(path_aside(options_.path));
  return Done{};
}

Expected<SavedFile> MappingSession::read_back() const {
  auto map = load_map(options_.path);
  if (!map) return forward_error(std::move(map));
  auto counted = summarize(*map, mapper_->config().occupancy);
  if (!counted) return forward_error(std::move(counted));
  std::error_code unreadable;  // then the size stays 0: it is only shown
  const auto bytes = std::filesystem::file_size(options_.path, unreadable);
  return SavedFile{options_.path,
                   unreadable ? 0 : bytes,
                   map->block_count(),
                   {counted->count(Occupancy::kFree), counted->count(Occupancy::kUnknown),
                    counted->count(Occupancy::kOccupied)}};
}

}  // namespace swiftlet::app
