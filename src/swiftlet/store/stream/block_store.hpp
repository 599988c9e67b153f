// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "swiftlet/map/block_archive.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/store/stream/batch_writer.hpp"
#include "swiftlet/store/stream/block_buffer.hpp"
#include "swiftlet/store/stream/block_set.hpp"

namespace swiftlet {

/// How the file of a flight is written.
struct BlockStoreOptions {
  StorePolicy policy = StorePolicy::kKeep;  ///< what becomes of blocks that leave the window
  std::uint64_t max_bytes = 0;  ///< cap of the map file's size; 0 = none, else at least 128 KiB
  std::chrono::milliseconds batch_interval{500};  ///< (0, 1000]: what a killed process may lose
  std::size_t pending_blocks = 16384;  ///< evicted and not yet written; two buffers of 8 MiB
  std::size_t cache_blocks = 16384;    ///< read ahead around the window; two buffers of 8 MiB
  bool overwrite = false;              ///< replaces a file of that name
};

/// What the store did so far.
struct BlockStoreStats {
  std::uint64_t evicted = 0;                ///< blocks that left the window
  std::uint64_t restored_from_pending = 0;  ///< that had not been written yet
  std::uint64_t restored_from_cache = 0;    ///< that had been read ahead
  std::uint64_t restored_from_disk = 0;     ///< that had to be read there and then
  std::uint64_t stalls = 0;                 ///< evictions that had to wait for the disk
  /// Evicted while the disk refused and the buffer was full, or left when the store was closed.
  std::uint64_t lost = 0;
  std::uint64_t restore_failed = 0;        ///< stored, but unreadable when the window came back
  std::uint64_t written = 0;               ///< block states written to the file
  std::uint64_t dropped_by_cap = 0;        ///< removed from the file since it was full
  std::uint64_t batches = 0;               ///< committed
  std::uint64_t refused_batches = 0;       ///< tried in vain; what they held is tried again
  std::uint64_t frames_committed = 0;      ///< the file holds everything up to this frame
  std::uint64_t blocks_stored = 0;         ///< in the file
  std::uint64_t bytes = 0;                 ///< of the map file, without pages free for reuse
  std::chrono::nanoseconds last_batch{0};  ///< how long it took to write
  std::optional<Error> error;  ///< newest failure to write or read; cleared by a good batch
};

/// The map file of a flight: takes what leaves the window, gives it back when the window returns,
/// and keeps the file up to date while mapping goes on.
///
/// Thread safety: create(), follow(), the BlockArchive functions and close() from the mapping
/// thread; stats() and note() from any. A thread of its own does the writing and the reading ahead.
/// Real time: evict() copies 512 bytes under a lock and does not allocate; restore() of a block
/// never stored is a look-up. Two cases may take longer, both counted: a stall (the disk is slower
/// than the flight) and a restore from disk (the window came back faster than it was read ahead).
/// Failures of the disk never stop the mapping; they are in stats() and close() returns them. While
/// the disk refuses, batches are tried less and less often, down to one in kLongestPause; what
/// leaves the window waits in the buffer, and is lost and counted when that is full.
class BlockStore final : public BlockArchive {
 public:
  /// Makes the file `path` and starts the writer. `meta` describes the map: config, source, ...
  /// Until close() this process is its writer (MapFile::writer_of()).
  /// Errors: kUsage if the file exists and may not be overwritten or is being written,
  /// kInvalidConfig, kIo, kOutOfMemory if the system starts no thread.
  [[nodiscard]] static Expected<std::unique_ptr<BlockStore>> create(
      const std::filesystem::path& path, double voxel_m, const BlockStoreOptions& options = {},
      MapMeta meta = {});
  ~BlockStore() override;

  /// From now on each batch holds the newest snapshot of the window, too.
  void follow(MapReader reader);
  /// Adds to the description of the map or changes it, with the next batch.
  void note(const std::string& key, const std::string& value);

  void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override;
  [[nodiscard]] bool restore(const BlockIndex& index, VoxelBlock& out) override;
  void expect_around(const BlockWindow& window) override;

  /// What it did so far. From any thread.
  [[nodiscard]] BlockStoreStats stats() const;

  static constexpr std::chrono::milliseconds kLongestPause{4000};  ///< between two tries to write

  /// Writes all that is left and the last state of the window, and leaves one single file.
  /// Without `last` the newest snapshot that was published is used. Later calls change nothing.
  /// Errors: kIo if anything could not be written: then all that the disk takes is there, and the
  /// rest is counted as lost.
  Status close(std::optional<MapSnapshot> last = std::nullopt);

 private:
  /// Opens the map of no blocks that create() has made.
  [[nodiscard]] static Expected<std::unique_ptr<BlockStore>> open(const std::filesystem::path& path,
                                                                  const BlockStoreOptions& options,
                                                                  MapMeta meta, MapLock lock);
  BlockStore(const BlockStoreOptions& options, BatchWriter writer, MapFile reading, MapMeta meta);
  void run();
  void write_batch();
  /// True if the batch was committed, and nothing is pending in writing_ any more.
  /// REQUIRES: called by the writer thread, or after it ended; as the two below.
  bool write_once(const MapSnapshot* window);
  /// Writes writing_ and the window, in parts if there is no room for all. Returns what is left.
  std::size_t write_what_fits(const MapSnapshot* window);
  std::size_t write_in_parts(BatchWriter::Content content, std::size_t blocks);
  void note_refusal(Error error);
  void account(const BatchWriter::Report& report, std::chrono::nanoseconds took);
  void swap_pending();
  void read_ahead(const BlockWindow& window);
  [[nodiscard]] bool restore_from_disk(const BlockIndex& index, VoxelBlock& out);

  const BlockStoreOptions options_;

  // The writer thread's own.
  BatchWriter writer_;
  BlockCodec read_ahead_codec_;
  std::chrono::milliseconds pause_;  // from batch to batch
  BlockBuffer next_cache_;

  // The mapping thread's own.
  MapFile reading_;
  BlockCodec restore_codec_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;  // the writer has something to do
  std::condition_variable room_;  // filling_ has room again, or will not have
  // Guarded by mutex_. The writer alone changes writing_ and cache_, so it reads them without.
  BlockBuffer filling_;  // evicted since the last batch
  BlockBuffer writing_;  // in the batch under way, or in one that failed and is tried again
  BlockBuffer cache_;    // equal to what the file holds
  BlockSet stored_;      // blocks in the file
  MapMeta notes_;
  std::optional<MapReader> reader_;  // set once
  std::optional<BlockWindow> expected_;
  bool drain_now_ = false;
  bool is_refused_ = false;  // the last batch failed
  bool is_closing_ = false;
  bool is_closed_ = false;
  BlockStoreStats stats_;

  std::thread thread_;  // started by open()
};

/// Saves one snapshot as a map file, with its voxel size and thresholds.
[[nodiscard]] Status save_map(const std::filesystem::path& path, const MapSnapshot& map,
                              bool overwrite = false, MapMeta meta = {});

}  // namespace swiftlet
