// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// What is left of a damaged map that tells of it, beside its blocks.
struct DescriptionRemains {
  MapMeta meta;                         ///< lines that can be read
  std::optional<MapChecksum> checksum;  ///< none: it is lost
  std::size_t blocks = 0;               ///< that can be read
  std::int64_t newest_frame = 0;        ///< of those blocks
};

/// What the map tells of itself: all of it if it is sound, else the lines that can be meant; what
/// is left out is told in `notes`. `path`: of the map, for errors. Errors: kCorruptInput if not
/// even the size of its voxels can be read.
[[nodiscard]] Expected<MapMeta> salvaged_description(const DescriptionRemains& found,
                                                     const std::filesystem::path& path,
                                                     std::vector<std::string>& notes);

}  // namespace swiftlet
