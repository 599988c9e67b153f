// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "swiftlet/file/output_file.hpp"
#include "swiftlet/store/export/exporters.hpp"
#include "swiftlet/store/export/far_points.hpp"
#include "swiftlet/store/export/reported_voxels.hpp"

namespace swiftlet {
namespace {

struct Rgb {
  std::uint8_t red, green, blue;
};

/// From blue at the bottom of the map over green to red at its top.
Rgb height_colour(double fraction) {
  const auto hill = [&](double centre) {
    const double v = std::clamp(1.5 - std::abs(4.0 * fraction - centre), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * v));
  };
  return {hill(3.0), hill(2.0), hill(1.0)};
}

std::string header(std::uint64_t points, const SavedMap& map, std::string_view coordinate) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "comment Swiftlet: centres of occupied voxels, {0} m, world frame, z up\n"
      "element vertex {1}\n"
      "property {2} x\nproperty {2} y\nproperty {2} z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uchar logodds\nend_header\n",
      map.voxel_m(), points, coordinate);
}

}  // namespace

Status export_ply(const SavedMap& map, const std::filesystem::path& out,
                  const ExportProgress& progress) {
  auto summary = summarize(map);
  if (!summary) return forward_error(std::move(summary));
  auto file = OutputFile::create(out, std::array{map.path()});
  if (!file) return forward_error(std::move(file));
  const bool is_float = floats_suffice(summary->bounds);
  file->write(header(summary->voxels.occupied, map, is_float ? "float" : "double"));
  const VoxelBox box = summary->bounds.value_or(VoxelBox{});
  const double height = std::max(1, box.last.z - box.first.z);
  auto passed = for_each_known_voxel(
      map, progress, [&](const VoxelIndex& v, QuantizedLogOdds voxel, Occupancy state) {
        if (state != Occupancy::kOccupied) return;
        for (const double c : centre_of(v, map.voxel_m())) {
          is_float ? file->write_little_endian(static_cast<float>(c))
                   : file->write_little_endian(c);
        }
        const Rgb colour = height_colour((v.z - box.first.z) / height);
        for (const std::uint8_t c : {colour.red, colour.green, colour.blue, voxel}) {
          file->write_little_endian(c);
        }
      });
  if (!passed) return passed;
  return file->commit();
}

}  // namespace swiftlet
