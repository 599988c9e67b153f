// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "swiftlet/map/block_directory.hpp"
#include "swiftlet/map/block_pool.hpp"
#include "swiftlet/map/frame_mark.hpp"
#include "swiftlet/map/log_odds_scale.hpp"

namespace swiftlet {

/// One published state of the map: a copy of the directory; the blocks themselves are shared.
struct SnapshotSlot {
  double voxel_m = 0.0;
  LogOddsScale scale{};
  BlockWindow window{};
  FrameMark mark{};
  std::uint64_t epoch = 0;  // 0 = never published
  BlockDirectory directory;
};

/// The blocks of a map and its published states: lets one writer go on while readers hold whole,
/// unchanging maps.
///
/// Copy on write with epochs. The writer works in epoch e; publish() closes it as snapshot e and
/// opens e + 1. A block born in epoch b and dropped in epoch d is what snapshots b .. d - 1 see, so
/// it may be reused once none of these is held. A block born before the present epoch is shared:
/// the writer replaces it by a copy before changing it. Readers take and release a slot with one
/// atomic each; the writer skips a publication if all slots are held. Thread safety: writer
/// functions belong to one thread; acquire() and release() to any.
class SnapshotStore {
 public:
  static constexpr int kSlots = 4;  ///< one newest, one being written, two held by slow readers

  SnapshotStore(BlockPool pool, const BlockIndex& window_size);

  // Writer.
  [[nodiscard]] BlockPool& pool() { return pool_; }
  [[nodiscard]] std::uint64_t epoch() const { return epoch_; }
  [[nodiscard]] bool is_shared(BlockId id) const { return pool_.born(id) < epoch_; }
  /// A new block of this epoch with unspecified voxels.
  [[nodiscard]] BlockId take();
  /// The map no longer uses this block; it goes back to the pool as soon as no snapshot shows it.
  void drop(BlockId id);
  /// Publishes the present state and opens the next epoch; false if every slot is held.
  bool publish(const BlockDirectory& directory, double voxel_m, const LogOddsScale& scale,
               const FrameMark& mark);
  /// Lets go of the newest snapshot (readers that hold it keep it), so that nobody pins its blocks.
  void withdraw();
  [[nodiscard]] bool has_readers() const { return readers_.load(std::memory_order_relaxed) > 0; }

  // Readers.
  [[nodiscard]] std::optional<int> acquire_latest();
  void hold(int slot) { holders_[slot].fetch_add(1); }
  void release(int slot) { holders_[slot].fetch_sub(1); }
  void add_reader() { readers_.fetch_add(1); }
  void remove_reader() { readers_.fetch_sub(1); }
  /// REQUIRES: the caller holds the slot.
  [[nodiscard]] const SnapshotSlot& slot(int index) const { return slots_[index]; }
  [[nodiscard]] const BlockPool& pool() const { return pool_; }

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Dropped {
    BlockId id;
    std::uint64_t died;  // epoch in which the map let go of it
  };
  [[nodiscard]] bool is_seen(const Dropped& dropped) const;
  void reclaim();

  static constexpr int kNoSlot = -1;
  static constexpr std::int32_t kBusy = 1 << 30;  // set while the writer fills a slot

  BlockPool pool_;
  std::uint64_t epoch_ = 1;
  std::vector<Dropped> dropped_;
  SnapshotSlot slots_[kSlots];
  std::atomic<std::int32_t> holders_[kSlots] = {};
  std::atomic<int> latest_{kNoSlot};
  std::atomic<int> readers_{0};
};

}  // namespace swiftlet
