// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/export/exporters.hpp"

#include <array>

// An exporter is one file, which ends in export_<name>(), and one line here: name, ALWAYS
// or the build option SWIFTLET_WITH_... that it needs, summary.
#define SWIFTLET_EXPORTERS(X)                                                              \
  X(ply, ALWAYS,                                                                           \
    "occupied voxels as points with log-odds, coloured by height (CloudCompare, MeshLab)") \
  X(pcd, ALWAYS, "occupied voxels as points, intensity = log-odds (PCL)")                  \
  X(mcap, ALWAYS,                                                                          \
    "occupied voxels as a PointCloud2 of ROS 2, in MCAP (Foxglove, Lichtblick, Rerun)")    \
  X(bt, OCTOMAP, "OctoMap, free and occupied voxels")                                      \
  X(ot, OCTOMAP, "OctoMap with the log-odds of each free and occupied voxel")

namespace swiftlet {

#define SWIFTLET_DECLARE(name, option, summary)                               \
  Status export_##name(const SavedMap& map, const std::filesystem::path& out, \
                       const ExportProgress& progress);
SWIFTLET_EXPORTERS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<ExportMap>> exporters() {
#define SWIFTLET_LINE(name, option, summary)                                                     \
  Registered<ExportMap>{#name, summary, SWIFTLET_IF_BUILT(SWIFTLET_HAS_##option, export_##name), \
                        #option},
  static constexpr std::array kExporters{SWIFTLET_EXPORTERS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kExporters;
}

Status export_map(std::string_view format, const SavedMap& map, const std::filesystem::path& out,
                  const ExportProgress& progress) {
  auto found = find_registered(exporters(), format, "export format");
  if (!found) return forward_error(std::move(found));
  if (found->make == nullptr) {
    return fail(ErrorCode::kUnsupported, std::string(format), "this build cannot write the format",
                "install OctoMap and configure with -DSWIFTLET_WITH_OCTOMAP=ON");
  }
  return found->make(map, out, progress);
}

}  // namespace swiftlet
