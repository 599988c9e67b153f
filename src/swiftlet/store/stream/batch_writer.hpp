// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/store/map_file/block_codec.hpp"
#include "swiftlet/store/map_file/map_file.hpp"
#include "swiftlet/store/stream/block_buffer.hpp"

namespace swiftlet {

/// What happens to what leaves the window.
enum class StorePolicy : std::uint8_t {
  kKeep,  ///< it stays in the file and comes back with the window
  kDrop,  ///< it is forgotten; the file holds the window only
};

/// Writes batches of blocks into a map file, each as one transaction: whole or not at all.
///
/// Two streams bring states of the same block: what the window evicted, and snapshots of the window
/// (checkpoints). A batch must leave the newest state in the file, whichever stream was slower.
/// The argument: a block's version is the epoch in which its state was born (SnapshotStore), and it
/// never falls over the block's life, also not when it leaves, is restored and changed again.
///   - Different versions: the higher one is newer.
///   - Same version, both evictions: the later call is newer (the block came back and went again
///     within one epoch); it is written.
///   - Same version, one from a snapshot: the snapshot closed that epoch, so it shows the last
///     state of that version; an eviction before it is older, one after it is equal. The snapshot
///     stays.
/// So the order is that of 2 * version, plus one for a snapshot, and a state equal to what the file
/// holds is not written twice. Thread safety: one thread at a time.
class BatchWriter {
 public:
  /// What a batch is made of; null for nothing. The window must be taken before the evicted blocks:
  /// then a block that is in neither was not there.
  struct Content {
    const MapSnapshot* window = nullptr;
    const BlockBuffer* evicted = nullptr;
    const MapMeta* meta = nullptr;
    /// Only these of the window's and of the evicted blocks, counted as they come, for a disk that
    /// has no room for all: then `frames` stays, as the file does not hold all of them.
    struct Part {
      std::size_t first;
      std::size_t last;  ///< one behind
    };
    std::optional<Part> part{};
  };
  /// What a batch changed.
  struct Report {
    std::vector<BlockIndex> written;
    std::vector<BlockIndex> erased;  ///< by policy or by the cap
    std::uint64_t dropped_by_cap = 0;
  };

  /// Opens a map of no blocks, see MapFile::create(), which gave the `lock`. `max_bytes`: see
  /// make_room(); 0 = no cap.
  [[nodiscard]] static Expected<BatchWriter> open(const std::filesystem::path& path,
                                                  StorePolicy policy, std::uint64_t max_bytes,
                                                  MapLock lock = {});

  /// After an error nothing has changed, neither here nor in the file; try again later.
  [[nodiscard]] Expected<Report> write(const Content& content);

  [[nodiscard]] bool holds(const BlockIndex& index) const;
  /// Blocks of the window whose newest state has not been written.
  [[nodiscard]] std::size_t unwritten(const MapSnapshot& window) const;
  [[nodiscard]] std::int64_t blocks() const { return checksum_.blocks; }
  /// Frames that the newest snapshot in the file had seen.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// What the file takes on disk, without its write-ahead log and pages free for reuse [bytes].
  [[nodiscard]] std::uint64_t bytes() const {
    return static_cast<std::uint64_t>(pages_ * MapFile::kPageBytes);
  }
  [[nodiscard]] MapFile& file() { return file_; }

 private:
  BatchWriter(MapFile file, StorePolicy policy, std::uint64_t max_bytes)
      : file_(std::move(file)), policy_(policy), max_bytes_(max_bytes) {}

  /// The state of a block that was last dealt with.
  struct Known {
    std::uint64_t order = 0;
    std::uint64_t checksum = 0;
    bool is_stored = false;  ///< false: dropped by the cap while in the window
  };
  [[nodiscard]] Status write_all(const Content& content, Report& report);
  [[nodiscard]] Status write_window(const Content& content, Report& report);
  [[nodiscard]] Status write_evicted(const Content& content, Report& report);
  [[nodiscard]] Status write_meta(const MapMeta& meta);
  [[nodiscard]] Status put(const BlockIndex& index, const VoxelBlock& block, std::uint64_t order,
                           Report& report);
  [[nodiscard]] Status erase(const BlockIndex& index, bool forget, Report& report);
  [[nodiscard]] Status erase_outside(const MapSnapshot& window, Report& report);
  [[nodiscard]] Status make_room(Report& report);
  void set_known(const BlockIndex& index, const std::optional<Known>& known);
  void undo();

  MapFile file_;
  StorePolicy policy_;
  std::uint64_t max_bytes_;
  BlockCodec codec_;
  std::unordered_map<BlockIndex, Known, BlockHash> known_;
  MapMeta meta_;
  MapChecksum checksum_;
  std::uint64_t frames_ = 0;
  std::int64_t pages_ = 0;
  std::optional<BlockWindow> window_;  // of the newest snapshot
  std::vector<std::pair<BlockIndex, std::optional<Known>>> undo_;
};

}  // namespace swiftlet
