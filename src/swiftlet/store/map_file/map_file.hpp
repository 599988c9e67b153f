// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/voxel_block.hpp"
#include "swiftlet/store/map_file/block_codec.hpp"
#include "swiftlet/store/map_file/map_lock.hpp"
#include "swiftlet/store/map_file/sqlite.hpp"

namespace swiftlet {

/// What is known about a map as a whole: lines of text by name (docs/formats/map_file.md lists the
/// names we write).
using MapMeta = std::map<std::string, std::string>;

/// One row of the table `blocks`; `data` is compressed (BlockCodec).
struct BlockRow {
  BlockIndex index;
  std::int64_t touched = 0;  ///< frames integrated when this state was written
  std::uint64_t checksum = 0;
  std::span<const std::uint8_t> data;  ///< valid during the call only

  /// Whether the checksum fits the rest.
  [[nodiscard]] bool is_intact() const;
};

/// What is wrong with a row, as a sentence about its block; nullopt if nothing is, and it stands in
/// `out`.
[[nodiscard]] std::optional<std::string> fault_of(const BlockRow& row, BlockCodec& codec,
                                                  VoxelBlock& out);

/// Decompresses a row into `out`. Errors: kCorruptInput naming the block if any of its bits
/// changed.
[[nodiscard]] Status decode_row(const BlockRow& row, BlockCodec& codec, VoxelBlock& out);

/// Sums over all rows, so that a row that vanished or appeared is noticed: checksums added modulo
/// 2^64, which makes the order of writing indifferent.
struct MapChecksum {
  std::int64_t blocks = 0;
  std::uint64_t block_digest = 0;
  std::uint64_t meta_digest = 0;
  friend bool operator==(const MapChecksum&, const MapChecksum&) = default;
};

/// The tables of a map file: every SQL sentence that Swiftlet speaks stands in map_file.cpp and
/// map_schema.cpp.
/// Thread safety: one thread at a time; any number of MapFiles may be open on one file, one of them
/// for writing.
class MapFile {
 public:
  static constexpr std::int64_t kApplicationId = 0x53574c54;  ///< "SWLT"; on disk, never change
  static constexpr std::int64_t kSchemaVersion = 1;           ///< readers refuse newer ones by name
  static constexpr std::int64_t kPageBytes = 4096;

  /// Makes a map of no blocks, complete with its description before it takes the name `path`, and
  /// holds its lock for open_to_write(), so that it has its writer before it has its name.
  /// Errors: kUsage if `path` exists and `overwrite` is not set, if it is being written, or if logs
  /// of another database lie beside it; kIo.
  [[nodiscard]] static Expected<MapLock> create(const std::filesystem::path& path, bool overwrite,
                                                const MapMeta& meta = {});
  /// Who writes the map at this moment; nobody if there is no such file. Its writer is the one
  /// that made it or opened it to write, until finish() or the end of the process.
  [[nodiscard]] static std::optional<MapWriter> writer_of(const std::filesystem::path& path) {
    return MapLock::holder(path);
  }
  /// Removes a map and its logs; does nothing while another process writes it.
  static void remove(const std::filesystem::path& path);
  /// Renames a map and its logs; a writer that was killed left some, and they are folded in first.
  /// Errors: kUsage while somebody writes it; kIo.
  [[nodiscard]] static Status rename(const std::filesystem::path& from,
                                     const std::filesystem::path& to);
  /// Changes nothing: what a killed writer has left is put right in a private copy if it cannot be
  /// read as it is, and so is a map in a folder that is read-only.
  /// Errors: kNotFound, kCorruptInput if it is no Swiftlet map or damaged, kUnsupported if it is of
  /// a newer version, kIo.
  /// `shown_as`: what errors call the file, if not by its path.
  [[nodiscard]] static Expected<MapFile> open_to_read(const std::filesystem::path& path,
                                                      const std::filesystem::path& shown_as = {});
  /// Opens the write-ahead log as well. `max_bytes`: hard limit of the file's size, 0 = none.
  /// `lock`: what create() has returned; without, it is taken. Errors: kUsage while another
  /// process writes the map; those of open_to_read().
  [[nodiscard]] static Expected<MapFile> open_to_write(const std::filesystem::path& path,
                                                       std::uint64_t max_bytes, MapLock lock = {});

  // Reading.
  /// From now on all reads see one state of the map, whatever a writer commits meanwhile.
  [[nodiscard]] Status hold_view();
  void let_go_of_view() { rollback(); }
  [[nodiscard]] Expected<MapMeta> meta();
  [[nodiscard]] Expected<MapChecksum> checksum();
  /// Calls visit(row) if the block is stored; true if it was.
  using VisitRow = std::function<Status(const BlockRow&)>;
  [[nodiscard]] Expected<bool> read(const BlockIndex& index, const VisitRow& visit);
  /// Every row, by z, then y, then x.
  [[nodiscard]] Status for_each(const VisitRow& visit);
  /// Complaints of SQLite's own integrity check; empty if it has none.
  [[nodiscard]] Expected<std::vector<std::string>> integrity_faults();

  /// Lets go of the file.
  void close();

  // Writing, between begin() and commit() or rollback().
  [[nodiscard]] Status begin();
  [[nodiscard]] Status commit();
  void rollback();
  [[nodiscard]] Status put(const BlockRow& row);
  [[nodiscard]] Status erase(const BlockIndex& index);
  [[nodiscard]] Status put_meta(const std::string& key, const std::string& value);
  [[nodiscard]] Status put_checksum(const MapChecksum& checksum);
  /// Calls visit(row) for the `count` blocks that were touched longest ago; without their data.
  [[nodiscard]] Status oldest(std::int64_t count, const VisitRow& visit);
  /// Pages of the file that are in use. REQUIRES: opened to write.
  [[nodiscard]] Expected<std::int64_t> pages_in_use();
  /// Folds the write-ahead log into the file, so that one file remains, and closes it.
  [[nodiscard]] Status finish();

 private:
  [[nodiscard]] static Expected<MapFile> with(const std::filesystem::path& path,
                                              Expected<sqlite::Database> database);
  [[nodiscard]] Status check_identity() const;
  [[nodiscard]] Status prepare_reading();
  [[nodiscard]] Status prepare_writing();

  std::filesystem::path path_;
  MapLock lock_;  // before the database: it must go last
  sqlite::Database database_;
  // Statements after the database: they must go first.
  sqlite::Statement read_, all_, put_, erase_, put_meta_, put_checksum_, oldest_, page_count_,
      free_pages_;
};

}  // namespace swiftlet
