// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "swiftlet/file/output_file.hpp"
#include "swiftlet/store/export/exporters.hpp"
#include "swiftlet/store/export/far_points.hpp"
#include "swiftlet/store/export/reported_voxels.hpp"

namespace swiftlet {

Status export_pcd(const SavedMap& map, const std::filesystem::path& out,
                  const ExportProgress& progress) {
  auto summary = summarize(map);
  if (!summary) return forward_error(std::move(summary));
  auto file = OutputFile::create(out, std::array{map.path()});
  if (!file) return forward_error(std::move(file));
  const std::uint64_t points = summary->voxels.occupied;
  // PCL takes coordinates as floats and no others; where these do not suffice, their origin moves.
  const Eigen::Vector3d origin_m = point_origin(summary->bounds, map.voxel_m());
  const std::string shift = origin_m.isZero()
                                ? ""
                                : fmt::format("# add ({}, {}, {}) m to every point\n", origin_m.x(),
                                              origin_m.y(), origin_m.z());
  file->write(
      fmt::format("# .PCD v0.7 - Point Cloud Data file format\n{1}"
                  "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
                  "WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
                  points, shift));
  auto passed = for_each_known_voxel(
      map, progress, [&](const VoxelIndex& v, QuantizedLogOdds voxel, Occupancy state) {
        if (state != Occupancy::kOccupied) return;
        const Eigen::Vector3f p = (centre_of(v, map.voxel_m()) - origin_m).cast<float>();
        const auto intensity = static_cast<float>(voxel);
        for (const float value : {p.x(), p.y(), p.z(), intensity}) {
          file->write_little_endian(value);
        }
      });
  if (!passed) return passed;
  return file->commit();
}

Expected<Eigen::Vector3d> pcd_origin(const SavedMap& map) {
  auto summary = summarize(map);
  if (!summary) return forward_error(std::move(summary));
  return point_origin(summary->bounds, map.voxel_m());
}

}  // namespace swiftlet
