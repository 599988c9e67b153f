// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/map_header.hpp"
#include "swiftlet/map/voxel_block.hpp"
#include "swiftlet/query/map_summary.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// A map file, opened to be read block by block; nothing of it is held in memory.
///
/// Checks instead of trusting: every block that is handed out has passed two checksums, and a whole
/// pass notices blocks that are missing or too many. Thread safety: one thread at a time.
class SavedMap {
 public:
  /// Of the file.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Voxel size, thresholds and what a step is worth, frames, start: as it was last written.
  [[nodiscard]] const MapHeader& header() const { return header_; }
  /// Edge of a voxel [m]
  [[nodiscard]] double voxel_m() const { return header_.voxel_m; }
  /// Where belief becomes a claim.
  [[nodiscard]] const OccupancyThresholds& thresholds() const { return header_.scale.thresholds; }
  /// Frames that it had seen.
  [[nodiscard]] std::uint64_t frames() const { return header_.frame_count; }
  /// Blocks that it says it holds.
  [[nodiscard]] std::uint64_t block_count() const { return block_count_; }
  /// All lines that describe it.
  [[nodiscard]] const MapMeta& meta() const { return meta_; }

  /// A map file that is open to be read; sees one state of it from now on. Errors: as load_map().
  [[nodiscard]] static Expected<SavedMap> of(const std::filesystem::path& path,
                                             Expected<MapFile> opened);

  /// Called for every block by z, then y, then x; an error ends the pass and is handed on.
  using VisitBlock = std::function<Status(const BlockIndex&, const VoxelBlock&)>;
  /// Errors: kCorruptInput naming the block; those of `visit`.
  [[nodiscard]] Status for_each_block(const VisitBlock& visit) const;

  /// One block; nullopt where nothing is known.
  [[nodiscard]] Expected<std::optional<VoxelBlock>> find(const BlockIndex& index) const;

 private:
  SavedMap() = default;

  std::filesystem::path path_;
  MapHeader header_;
  std::uint64_t block_count_ = 0;
  MapMeta meta_;
  mutable std::unique_ptr<MapFile> file_;  // reading moves a cursor, not the map
};

/// Opens a map, also one whose writer was killed or is at work (then: its last batch).
/// Errors: kNotFound, kCorruptInput, kUnsupported if it is of a newer version, kIo.
[[nodiscard]] Expected<SavedMap> load_map(const std::filesystem::path& path);

/// How much a map file knows, and where, by its own thresholds. Errors: those of for_each_block().
[[nodiscard]] Expected<MapSummary> summarize(const SavedMap& map);

/// Everything that is wrong with a file, read from its first byte to its last; empty if nothing is.
[[nodiscard]] std::vector<Error> check_map(const std::filesystem::path& path);

}  // namespace swiftlet
