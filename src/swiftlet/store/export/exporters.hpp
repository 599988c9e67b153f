// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet {

/// Told now and then how much is done, from 0 to 1; may be empty.
using ExportProgress = std::function<void(double fraction)>;

/// Writes a map in another program's format, by the map's own thresholds. The file appears whole or
/// not at all. Errors: kIo; kCorruptInput if the map is damaged; kUnsupported if the format cannot
/// hold it.
using ExportMap = Status (*)(const SavedMap& map, const std::filesystem::path& out,
                             const ExportProgress& progress);

/// What is to be added to every point of the PCD of a map [m]: zero but far from the origin, where
/// floats, the only coordinates that PCL takes, no longer tell voxels apart. (PLY has doubles
/// there.)
[[nodiscard]] Expected<Eigen::Vector3d> pcd_origin(const SavedMap& map);

/// All formats, built or not (null), in the order of `swiftlet list`.
[[nodiscard]] std::span<const Registered<ExportMap>> exporters();

/// Exports under the name of the format. Errors: kUsage for an unknown one, kUnsupported for one
/// that was not built, and those of the exporter.
[[nodiscard]] Status export_map(std::string_view format, const SavedMap& map,
                                const std::filesystem::path& out,
                                const ExportProgress& progress = {});

}  // namespace swiftlet
