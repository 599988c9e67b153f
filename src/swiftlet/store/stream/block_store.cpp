// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/stream/block_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/base/start_thread.hpp"
#include "swiftlet/store/map_file/header_lines.hpp"

namespace swiftlet {
namespace {

constexpr std::uint64_t kMinCapBytes = std::uint64_t{128} << 10U;

Status validate(const BlockStoreOptions& o) {
  using std::chrono::milliseconds;
  if (o.batch_interval <= milliseconds(0) || o.batch_interval > milliseconds(1000)) {
    return fail(ErrorCode::kInvalidConfig, "store.batch_interval",
                "the interval must lie between 1 and 1000 ms");
  }
  if (o.max_bytes != 0 && o.max_bytes < kMinCapBytes) {
    return fail(ErrorCode::kInvalidConfig, "store.max_bytes",
                "the cap must be at least 131072 bytes, or 0 for none");
  }
  if (o.pending_blocks == 0) {
    return fail(ErrorCode::kInvalidConfig, "store.pending_blocks", "there must be room for one");
  }
  return Done{};
}

}  // namespace

Expected<std::unique_ptr<BlockStore>> BlockStore::create(const std::filesystem::path& path,
                                                         double voxel_m,
                                                         const BlockStoreOptions& options,
                                                         MapMeta meta) {
  if (auto valid = validate(options); !valid) return forward_error(std::move(valid));
  // With its description from the start: a map whose writer is killed before a frame is valid.
  meta["voxel_m"] = fmt::format("{}", voxel_m);
  meta["frames"] = "0";
  auto lock = MapFile::create(path, options.overwrite, meta);
  if (!lock) return forward_error(std::move(lock));
  auto store = open(path, options, std::move(meta), std::move(*lock));
  if (!store) MapFile::remove(path);
  return store;
}

Expected<std::unique_ptr<BlockStore>> BlockStore::open(const std::filesystem::path& path,
                                                       const BlockStoreOptions& options,
                                                       MapMeta meta, MapLock lock) {
  auto writer = BatchWriter::open(path, options.policy, options.max_bytes, std::move(lock));
  if (!writer) return forward_error(std::move(writer));
  // Proves, before the flight, that the disk takes what is written.
  if (auto written = writer->write({nullptr, nullptr, &meta}); !written) {
    return forward_error(std::move(written));
  }
  auto reading = MapFile::open_to_read(path);
  if (!reading) return forward_error(std::move(reading));
  std::unique_ptr<BlockStore> store(
      new BlockStore(options, std::move(*writer), std::move(*reading), std::move(meta)));
  auto thread = start_thread(path.string(), [&own = *store] { own.run(); });
  if (!thread) {
    store->is_closed_ = true;  // there is nothing to write
    return forward_error(std::move(thread));
  }
  store->thread_ = std::move(*thread);
  return store;
}

BlockStore::BlockStore(const BlockStoreOptions& options, BatchWriter writer, MapFile reading,
                       MapMeta meta)
    : options_(options),
      writer_(std::move(writer)),
      pause_(options.batch_interval),
      next_cache_(options.cache_blocks),
      reading_(std::move(reading)),
      filling_(options.pending_blocks),
      writing_(options.pending_blocks),
      cache_(options.cache_blocks),
      notes_(std::move(meta)) {}

BlockStore::~BlockStore() { static_cast<void>(close()); }

void BlockStore::follow(MapReader reader) {
  const std::lock_guard lock(mutex_);
  if (!reader_) reader_.emplace(std::move(reader));
}

void BlockStore::note(const std::string& key, const std::string& value) {
  const std::lock_guard lock(mutex_);
  notes_[key] = value;
}

void BlockStore::evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) {
  std::unique_lock lock(mutex_);
  ++stats_.evicted;
  if (options_.policy == StorePolicy::kDrop || is_closed_) return;
  bool was_put = filling_.put(index, block, version);
  if (!was_put && !is_refused_) {
    ++stats_.stalls;
    drain_now_ = true;
    wake_.notify_one();
    room_.wait(lock, [&] { return !filling_.full() || is_refused_; });
    was_put = filling_.put(index, block, version);
  }
  if (!was_put) {
    ++stats_.lost;  // the disk refuses: the flight matters more than its map
    return;
  }
  if (!drain_now_ && filling_.size() * 2 >= options_.pending_blocks && !is_refused_) {
    drain_now_ = true;
    wake_.notify_one();
  }
}

bool BlockStore::restore(const BlockIndex& index, VoxelBlock& out) {
  {
    const std::lock_guard lock(mutex_);
    if (options_.policy == StorePolicy::kDrop) return false;
    // Newest first: evicted since the last batch, in the batch under way, in the file.
    for (const BlockBuffer* pending : {&filling_, &writing_}) {
      if (const VoxelBlock* block = pending->find(index)) {
        out = *block;
        ++stats_.restored_from_pending;
        return true;
      }
    }
    if (!stored_.contains(index)) return false;
    if (const VoxelBlock* block = cache_.find(index)) {
      out = *block;
      ++stats_.restored_from_cache;
      return true;
    }
  }
  return restore_from_disk(index, out);
}

bool BlockStore::restore_from_disk(const BlockIndex& index, VoxelBlock& out) {
  auto found = reading_.read(
      index, [&](const BlockRow& row) { return decode_row(row, restore_codec_, out); });
  const std::lock_guard lock(mutex_);
  if (!found) {
    ++stats_.restore_failed;
    stats_.error = std::move(found).error();
    return false;
  }
  if (*found) ++stats_.restored_from_disk;
  return *found;  // false: the cap dropped it this very moment
}

void BlockStore::expect_around(const BlockWindow& window) {
  if (options_.policy == StorePolicy::kDrop) return;
  const std::lock_guard lock(mutex_);
  expected_ = window;
  wake_.notify_one();
}

BlockStoreStats BlockStore::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

Status BlockStore::close(std::optional<MapSnapshot> last) {
  {
    const std::lock_guard lock(mutex_);
    if (is_closed_) return Done{};
    is_closing_ = true;
    wake_.notify_one();
  }
  thread_.join();
  if (!last && reader_) last = reader_->latest();
  std::size_t left = writing_.empty() ? 0 : write_what_fits(nullptr);
  swap_pending();
  left += write_what_fits(last ? &*last : nullptr);
  last.reset();
  reader_.reset();
  reading_.close();
  Status finished = writer_.file().finish();
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  stats_.lost += left;
  if (stats_.lost == 0) return finished;
  // The reason of an earlier refusal is gone by now if the disk has taken the rest.
  const Error reason = stats_.error.value_or(Error{ErrorCode::kIo, "map", {}, {}});
  return fail(ErrorCode::kIo, reason.where,
              fmt::format("{} blocks could not be written and are lost{}{}", stats_.lost,
                          reason.what.empty() ? "" : ": ", reason.what),
              "free some space; the map holds the rest");
}

Status save_map(const std::filesystem::path& path, const MapSnapshot& map, bool overwrite,
                MapMeta meta) {
  BlockStoreOptions options;
  options.overwrite = overwrite;
  options.pending_blocks = 1;  // one batch, from the snapshot
  options.cache_blocks = 1;
  put_header({map.voxel_m(), map.scale(), map.frame_count()}, meta);
  auto store = BlockStore::create(path, map.voxel_m(), options, std::move(meta));
  if (!store) return forward_error(std::move(store));
  return (*store)->close(map);
}

}  // namespace swiftlet
