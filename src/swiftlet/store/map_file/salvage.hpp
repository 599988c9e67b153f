// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet {

/// What of a damaged map could be kept, and what is missing.
struct SalvageReport {
  std::uint64_t kept = 0;  ///< blocks, each as it was written: its checksum fits
  /// Blocks that were written and are not among them; nullopt if the file does not tell any more.
  std::optional<std::uint64_t> missing;
  /// Blocks that are there and damaged, by z, y, x; at most kMostNamed of them.
  std::vector<BlockIndex> damaged;
  /// Between these two blocks, in the order z, y, x, a page cannot be read; nullopt where the map
  /// begins or ends. At most kMostNamed of them.
  struct Gap {
    std::optional<BlockIndex> after;
    std::optional<BlockIndex> before;
  };
  std::vector<Gap> gaps;
  std::vector<std::string> notes;  ///< on what the map tells of itself

  static constexpr std::size_t kMostNamed = 20;
  [[nodiscard]] bool is_whole() const {
    return missing == 0U && damaged.empty() && gaps.empty() && notes.empty();
  }
  /// One line each: what is missing and where.
  [[nodiscard]] std::vector<std::string> lines() const;
};

/// Writes what can be read of a map, however damaged it is, as a new and sound map `out`. A block
/// is kept if its checksum fits, and no other is. The map itself is not touched.
/// Errors: kCorruptInput if the voxel size cannot be found, kUsage if `out` exists, kIo, kNotFound.
[[nodiscard]] Expected<SalvageReport> salvage_map(const std::filesystem::path& path,
                                                  const std::filesystem::path& out);

/// Opens what can be read of a map, from a copy that is gone at the end.
[[nodiscard]] Expected<std::pair<SavedMap, SalvageReport>> load_salvaged(
    const std::filesystem::path& path);

}  // namespace swiftlet
