// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the store's own thread does: batches, and reading ahead. The mapping thread's half is in
// block_store.cpp.

#include <algorithm>
#include <utility>

#include "swiftlet/store/stream/block_store.hpp"

namespace swiftlet {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kReadAheadBlocks = 2;  // shells around the window: two moves by one block

BlockWindow grown(const BlockWindow& w, int by) {
  return {{w.first.x - by, w.first.y - by, w.first.z - by},
          {w.size.x + 2 * by, w.size.y + 2 * by, w.size.z + 2 * by}};
}

}  // namespace

void BlockStore::run() {
  auto next_batch = Clock::now() + pause_;
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait_until(lock, next_batch, [&] { return is_closing_ || drain_now_ || expected_; });
    if (is_closing_) return;
    if (expected_) {
      const BlockWindow window = *std::exchange(expected_, std::nullopt);
      lock.unlock();
      read_ahead(window);
      lock.lock();
    }
    if (!drain_now_ && Clock::now() < next_batch) continue;
    drain_now_ = false;
    // From the start of one batch to the start of the next, so that the interval holds on average.
    const auto start = Clock::now();
    lock.unlock();
    write_batch();
    lock.lock();
    pause_ = is_refused_ ? std::min(2 * pause_, kLongestPause) : options_.batch_interval;
    next_batch = start + pause_;
  }
}

void BlockStore::write_batch() {
  // What an earlier batch could not write goes first and alone: with it, filling_ cannot be taken
  // along, and a snapshot without the evictions before it would leave a gap.
  if (!writing_.empty() && !write_once(nullptr)) return;
  const MapReader* reader = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (reader_) reader = &*reader_;
  }
  const std::optional<MapSnapshot> window = reader == nullptr ? std::nullopt : reader->latest();
  swap_pending();
  write_once(window ? &*window : nullptr);
}

void BlockStore::swap_pending() {
  const std::lock_guard lock(mutex_);
  std::swap(filling_, writing_);
  room_.notify_all();
}

bool BlockStore::write_once(const MapSnapshot* window) {
  const auto start = Clock::now();
  MapMeta notes;
  {
    const std::lock_guard lock(mutex_);
    notes = notes_;
  }
  auto report = writer_.write({window, &writing_, &notes});
  if (!report) {
    note_refusal(std::move(report).error());
    return false;
  }
  account(*report, Clock::now() - start);
  const std::lock_guard lock(mutex_);
  writing_.clear();
  stats_.error.reset();
  is_refused_ = false;
  room_.notify_all();
  return true;
}

void BlockStore::note_refusal(Error error) {
  const std::lock_guard lock(mutex_);
  ++stats_.refused_batches;
  stats_.error = std::move(error);
  is_refused_ = true;
  room_.notify_all();
}

std::size_t BlockStore::write_what_fits(const MapSnapshot* window) {
  if (write_once(window)) return 0;
  // The evicted ones first: they are the map; the window is what the last frames saw again.
  const std::size_t left = write_in_parts({nullptr, &writing_, nullptr}, writing_.size());
  {
    const std::lock_guard lock(mutex_);
    writing_.clear();
  }
  if (window == nullptr) return left;
  std::size_t known = 0;
  window->for_each_known_block([&](const BlockIndex&, const VoxelBlock&) { ++known; });
  write_in_parts({window, nullptr, nullptr}, known);
  return left + writer_.unwritten(*window);
}

/// Half, a quarter, ... of what is left, until not even a few blocks find room.
std::size_t BlockStore::write_in_parts(BatchWriter::Content content, std::size_t blocks) {
  constexpr std::size_t kSmallest = 16;
  std::size_t done = 0;
  for (std::size_t size = (blocks + 1) / 2; done < blocks;) {
    content.part = {done, std::min(done + size, blocks)};
    const auto start = Clock::now();
    if (auto report = writer_.write(content)) {
      account(*report, Clock::now() - start);
      done = content.part->last;
      continue;
    } else {
      note_refusal(std::move(report).error());
    }
    if (size <= kSmallest) break;
    size = (size + 1) / 2;
  }
  return blocks - done;
}

void BlockStore::account(const BatchWriter::Report& report, std::chrono::nanoseconds took) {
  // In short turns, for the mapping thread may be waiting; writing_ answers for the blocks until
  // the end.
  constexpr std::size_t kTurn = 512;
  for (const auto* changed : {&report.written, &report.erased}) {
    for (std::size_t i = 0; i < changed->size();) {
      const std::lock_guard lock(mutex_);
      for (const std::size_t end = std::min(i + kTurn, changed->size()); i < end; ++i) {
        const BlockIndex& index = (*changed)[i];
        cache_.forget(index);
        if (writer_.holds(index)) {
          stored_.insert(index);
        } else {
          stored_.erase(index);
        }
      }
    }
  }
  const std::lock_guard lock(mutex_);
  stats_.written += report.written.size();
  stats_.dropped_by_cap += report.dropped_by_cap;
  ++stats_.batches;
  stats_.frames_committed = writer_.frames();
  stats_.blocks_stored = static_cast<std::uint64_t>(writer_.blocks());
  stats_.bytes = writer_.bytes();
  stats_.last_batch = took;
}

void BlockStore::read_ahead(const BlockWindow& window) {
  next_cache_.clear();
  std::optional<Error> error;
  VoxelBlock block;
  const auto read = [&](const BlockIndex& index) {
    if (next_cache_.full() || !writer_.holds(index)) return;
    if (const VoxelBlock* cached = cache_.find(index)) {
      next_cache_.put(index, *cached, 0);
      return;
    }
    auto found = writer_.file().read(
        index, [&](const BlockRow& row) { return decode_row(row, read_ahead_codec_, block); });
    if (!found) {
      error = std::move(found).error();
    } else if (*found) {
      next_cache_.put(index, block, 0);
    }
  };
  for (int shell = 1; shell <= kReadAheadBlocks; ++shell) {
    const BlockWindow inner = grown(window, shell - 1);
    for_each_block(grown(window, shell), [&](const BlockIndex& index) {
      if (!inner.contains(index)) read(index);
    });
  }
  const std::lock_guard lock(mutex_);
  std::swap(cache_, next_cache_);
  if (error) stats_.error = std::move(error);
}

}  // namespace swiftlet
