// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/snapshot_store.hpp"

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

SnapshotStore::SnapshotStore(BlockPool pool, const BlockIndex& window_size)
    : pool_(std::move(pool)) {
  dropped_.reserve(pool_.capacity());
  for (SnapshotSlot& slot : slots_) slot.directory = BlockDirectory(window_size);
}

BlockId SnapshotStore::take() {
  BlockId id = pool_.take(epoch_);
  if (id == kNoBlock) {
    reclaim();
    id = pool_.take(epoch_);
  }
  // The pool holds one whole window for the writer and one for each slot, and a slot shows at most
  // one window.
  SWIFTLET_REQUIRE(id != kNoBlock,
                   "the block pool is sized for the window and every snapshot slot");
  return id;
}

void SnapshotStore::drop(BlockId id) {
  if (is_shared(id)) {
    dropped_.push_back({id, epoch_});
  } else {
    pool_.give_back(id);
  }
}

bool SnapshotStore::is_seen(const Dropped& dropped) const {
  const int latest = latest_.load();
  for (int i = 0; i < kSlots; ++i) {
    // Sequentially consistent with acquire_latest(): a reader that this load misses will find that
    // the slot is no longer the latest, and let go without looking at it.
    const bool is_held = i == latest || holders_[i].load() > 0;
    const std::uint64_t epoch = slots_[i].epoch;
    if (is_held && epoch >= pool_.born(dropped.id) && epoch < dropped.died) return true;
  }
  return false;
}

void SnapshotStore::reclaim() {
  std::size_t kept = 0;
  for (const Dropped& dropped : dropped_) {
    if (is_seen(dropped)) {
      dropped_[kept++] = dropped;
    } else {
      pool_.give_back(dropped.id);
    }
  }
  dropped_.resize(kept);
}

bool SnapshotStore::publish(const BlockDirectory& directory, double voxel_m,
                            const LogOddsScale& scale, const FrameMark& mark) {
  const int latest = latest_.load();
  for (int i = 0; i < kSlots; ++i) {
    std::int32_t nobody = 0;
    if (i == latest || !holders_[i].compare_exchange_strong(nobody, kBusy)) continue;
    SnapshotSlot& slot = slots_[i];
    slot.voxel_m = voxel_m;
    slot.scale = scale;
    slot.window = directory.window();
    slot.mark = mark;
    slot.epoch = epoch_++;
    slot.directory = directory;  // same size: copies without allocating
    holders_[i].fetch_sub(kBusy);
    latest_.store(i);
    reclaim();
    return true;
  }
  return false;
}

void SnapshotStore::withdraw() {
  if (latest_.load() == kNoSlot) return;
  latest_.store(kNoSlot);
  reclaim();
}

std::optional<int> SnapshotStore::acquire_latest() {
  for (;;) {
    const int slot = latest_.load();
    if (slot == kNoSlot) return std::nullopt;
    const std::int32_t before = holders_[slot].fetch_add(1);
    if (before < kBusy && latest_.load() == slot) return slot;
    holders_[slot].fetch_sub(1);
  }
}

std::size_t SnapshotStore::memory_bytes() const {
  const std::size_t directories = kSlots * slots_[0].directory.entry_count() * sizeof(BlockId);
  return pool_.memory_bytes() + directories + dropped_.capacity() * sizeof(Dropped);
}

}  // namespace swiftlet
