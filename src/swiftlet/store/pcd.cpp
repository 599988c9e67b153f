// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <utility>

#include "swiftlet/store/exporters.hpp"
#include "swiftlet/store/known_cells.hpp"
#include "swiftlet/store/output_file.hpp"

namespace swiftlet {

Status export_pcd(const SavedMap& map, const OccupancyThresholds& thresholds,
                  const std::filesystem::path& out, const ExportProgress& progress) {
  auto summary = summarize(map, thresholds);
  if (!summary) return forward_error(std::move(summary));
  auto file = OutputFile::create(out);
  if (!file) return forward_error(std::move(file));
  const std::uint64_t points = summary->count(Occupancy::kOccupied);
  file->write(
      fmt::format("# .PCD v0.7 - Point Cloud Data file format\n"
                  "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
                  "WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
                  points));
  auto passed = for_each_known_cell(
      map, thresholds, progress, [&](const VoxelIndex& v, LogOdds cell, Occupancy state) {
        if (state != Occupancy::kOccupied) return;
        const Eigen::Vector3f p_world = centre_of(v, map.voxel_m()).cast<float>();
        const auto intensity = static_cast<float>(cell);
        for (const float value : {p_world.x(), p_world.y(), p_world.z(), intensity}) {
          file->write_little_endian(value);
        }
      });
  if (!passed) return passed;
  return file->commit();
}

}  // namespace swiftlet
