// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/map_header.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// What the lines of a map file tell of the map (docs/formats/map_file.md); `path`: of the file,
/// for errors. Errors: kCorruptInput for a line that is missing or cannot be meant.
[[nodiscard]] Expected<MapHeader> header_from(const MapMeta& meta, const std::string& path);

/// The thresholds that the lines tell: by lines of their own, in older files inside the config; the
/// defaults if by neither. Errors: kCorruptInput.
[[nodiscard]] Expected<OccupancyThresholds> thresholds_from(const MapMeta& meta,
                                                            const std::string& path);

/// The place that the text of `start_m` tells: three numbers with blanks between; nullopt if that
/// is no place where a map with voxels of `voxel_m` can be.
[[nodiscard]] std::optional<Eigen::Vector3d> place_from(std::string_view text, double voxel_m);

/// Writes the lines that tell a header, over those that are there. What it does not tell (0 frames,
/// no start) stays as it is; `frames` is always there.
void put_header(const MapHeader& header, MapMeta& meta);

}  // namespace swiftlet
