// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/mapping_session.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "swiftlet/session/flight_file.hpp"
#include "swiftlet/store/map_file/header_lines.hpp"
#include "swiftlet/store/map_file/map_file.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet {

Expected<std::unique_ptr<MappingSession>> MappingSession::create(const MapperConfig& config,
                                                                 const SessionOptions& options) {
  std::unique_ptr<MappingSession> session(new MappingSession(options));
  if (auto begun = session->begin_map(config); !begun) return forward_error(std::move(begun));
  return session;
}

Status MappingSession::begin_map(const MapperConfig& config) {
  MapperConfig used = config;
  // Cleared or refused: what the new world is mapped into is for the session to say.
  if (used.on_new_world == NewWorldRule::kClear) used.on_new_world = NewWorldRule::kRefuse;
  auto mapper = Mapper::create(used, &archive_);
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

void MappingSession::keep_failure(Error failure) {
  if (!failure_) failure_ = std::move(failure);
}

Expected<std::unique_ptr<BlockStore>> MappingSession::new_store(const std::filesystem::path& path,
                                                                bool overwrite) {
  MapMeta meta = options_.meta;
  put_header({mapper_->map().voxel_m(), mapper_->map().scale(), 0, start_m_}, meta);
  meta[std::string(kFlightKey)] = kUnderWay;
  if (!aside_.empty() && paths_.empty()) meta[std::string(kReplacesKey)] = aside_.filename();
  BlockStoreOptions options = options_.store;
  options.overwrite = overwrite;
  return BlockStore::create(path, mapper_->map().voxel_m(), options, std::move(meta));
}

void MappingSession::adopt(std::unique_ptr<BlockStore> store, const std::filesystem::path& path) {
  store_ = std::move(store);
  store_->follow(mapper_->reader());
  archive_.attach(*store_);
  paths_.push_back(path);
}

Status MappingSession::create_first_file() {
  std::error_code unreadable;
  if (options_.store.overwrite && std::filesystem::is_regular_file(options_.path, unreadable)) {
    auto aside = set_map_aside(options_.path);
    if (!aside) return forward_error(std::move(aside));
    aside_ = std::move(*aside);
  }
  auto store = new_store(options_.path, options_.store.overwrite);
  if (!store) {
    if (!aside_.empty() && put_map_back(aside_, options_.path)) aside_.clear();
    return forward_error(std::move(store));
  }
  adopt(std::move(*store), options_.path);
  return Done{};
}

Status MappingSession::create_file() {
  if (paths_.empty()) return create_first_file();
  const auto path = free_path_of_world(options_.path, summary_.restarts + 1);
  auto store = new_store(path, false);  // in flight nobody can be asked
  if (!store) return forward_error(std::move(store));
  adopt(std::move(*store), path);
  return Done{};
}

/// The tracker has lost its place: what was mapped lies anywhere, seen from now on. It is kept in
/// its file.
void MappingSession::start_again(std::uint32_t pose_epoch) {
  close_file();
  ++summary_.restarts;
  pose_epoch_ = pose_epoch;
  mapper_->begin_world(pose_epoch);
  if (options_.observer != nullptr) options_.observer->map_begun(*mapper_);
}

Status MappingSession::integrate(const Frame& frame) {
  const bool keeps = mapper_->config().on_new_world == NewWorldRule::kKeep;
  if (!keeps && start_m_ && frame.pose_epoch > pose_epoch_) start_again(frame.pose_epoch);
  const MapUpdate update = mapper_->integrate(frame);
  book(frame, update);
  if (options_.observer != nullptr) options_.observer->frame_done(frame, update, *mapper_);
  if (update.verdict != FrameVerdict::kIntegrated) return Done{};
  const bool is_first = !start_m_;
  if (is_first) {
    start_m_ = frame.T_world_camera.translation();
    pose_epoch_ = frame.pose_epoch;
  }
  if (update.shift.moved) count_losses();
  // Not with every frame: a disk that has just refused will do it again.
  if (store_ != nullptr || !(is_first || update.shift.moved)) return Done{};
  Status made = create_file();
  if (made || paths_.empty()) return made;
  keep_failure(std::move(made).error());  // of a later world: the flight goes on
  return Done{};
}

void MappingSession::count_losses() {
  summary_.blocks_lost = lost_before_ + archive_.lost();
  if (store_ != nullptr) summary_.blocks_lost += store_->stats().lost;
}

/// No snapshot (readers hold all of them): the store writes the newest that was published.
void MappingSession::close_file() {
  if (!start_m_) return;
  if (store_ == nullptr) {
    if (auto made = create_file(); !made) keep_failure(std::move(made).error());
  }
  start_m_.reset();
  if (store_ == nullptr) return;
  if (auto closed = store_->close(mapper_->snapshot()); !closed)
    keep_failure(std::move(closed).error());
  lost_before_ += store_->stats().lost;
  archive_.detach();
  store_.reset();
  count_losses();
}

/// Only now, when every file is closed: until then they are of a flight that may be cut off.
void MappingSession::mark_saved() {
  const bool is_whole = !failure_ && summary_.blocks_lost == 0;
  MapMeta lines{{std::string(kFlightKey), std::string(is_whole ? kSavedWhole : kSavedInPart)}};
  if (!summary_.depth_doubt.empty()) lines["depth_doubt"] = summary_.depth_doubt;
  if (!summary_.notes.empty()) lines["notes"] = fmt::format("{}", fmt::join(summary_.notes, "\n"));
  // The first, by whose name the next start judges, at last.
  for (auto path = paths_.rbegin(); path != paths_.rend(); ++path) {
    if (auto marked = mark_map(*path, lines); !marked) keep_failure(std::move(marked).error());
  }
}

Status MappingSession::save() {
  close_file();
  mark_saved();
  for (const auto& path : paths_) {
    if (auto file = read_back(path)) {
      summary_.files.push_back(std::move(*file));
    } else {
      keep_failure(std::move(file).error());
    }
  }
  if (summary_.blocks_lost > 0) {
    return fail(ErrorCode::kIo, options_.path,
                fmt::format("the disk had no room for the newest state of {} blocks{}; the map is "
                            "saved as of frame {}",
                            summary_.blocks_lost, failure_ ? " (" + failure_->what + ")" : "",
                            summary_.files.empty() ? 0 : summary_.files.back().frames),
                "make room and fly again");
  }
  if (failure_) return tl::make_unexpected(*failure_);
  if (!aside_.empty()) MapFile::remove(aside_);
  aside_.clear();
  return Done{};
}

Expected<SavedFile> MappingSession::read_back(const std::filesystem::path& path) const {
  auto map = load_map(path);
  if (!map) return forward_error(std::move(map));
  auto counted = summarize(*map);
  if (!counted) return forward_error(std::move(counted));
  std::error_code unreadable;  // then the size stays 0: it is only shown
  const auto bytes = std::filesystem::file_size(path, unreadable);
  return SavedFile{path.string(), unreadable ? 0 : bytes, map->block_count(), map->frames(),
                   counted->voxels};
}

}  // namespace swiftlet
