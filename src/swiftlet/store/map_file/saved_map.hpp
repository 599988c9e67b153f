// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/voxel_block.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// A map file, opened to be read block by block; nothing of it is held in memory.
///
/// Checks instead of trusting: every block that is handed out has passed two checksums, and a whole
/// pass notices blocks that are missing or too many. Thread safety: one thread at a time.
class SavedMap {
 public:
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  /// Frames that the map had seen when it was last written.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t block_count() const { return block_count_; }
  [[nodiscard]] const MapMeta& meta() const { return meta_; }
  /// The camera at the first frame [m, world]; nullopt if the map does not tell it.
  [[nodiscard]] const std::optional<std::array<double, 3>>& start_m() const { return start_m_; }

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
  double voxel_m_ = 0.0;
  std::uint64_t frames_ = 0;
  std::uint64_t block_count_ = 0;
  MapMeta meta_;
  std::optional<std::array<double, 3>> start_m_;
  mutable std::unique_ptr<MapFile> file_;  // reading moves a cursor, not the map
};

/// Opens a map, also one whose writer was killed or is at work (then: its last batch).
/// Errors: kNotFound, kCorruptInput, kUnsupported if it is of a newer version, kIo.
[[nodiscard]] Expected<SavedMap> load_map(const std::filesystem::path& path);

/// The place that the text of `start_m` tells: three numbers with blanks between; nullopt if that
/// is no place where a map with cells of `voxel_m` can be.
[[nodiscard]] std::optional<std::array<double, 3>> place_from(std::string_view text,
                                                              double voxel_m);

/// What `swiftlet info` tells about the cells of a map.
struct MapSummary {
  std::array<std::uint64_t, 3> cells{};  ///< by Occupancy, in the stored blocks
  std::optional<VoxelBox> bounds;        ///< of the free and occupied cells
  [[nodiscard]] std::uint64_t count(Occupancy state) const {
    return cells[static_cast<std::size_t>(state)];
  }
};
[[nodiscard]] Expected<MapSummary> summarize(const SavedMap& map,
                                             const OccupancyThresholds& thresholds);

/// Everything that is wrong with a file, read from its first byte to its last; empty if nothing is.
[[nodiscard]] std::vector<Error> check_map(const std::filesystem::path& path);

}  // namespace swiftlet
