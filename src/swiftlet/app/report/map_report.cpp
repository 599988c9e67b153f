// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/map_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/app/visible_text.hpp"

namespace swiftlet::app {
namespace {

/// The corners of the known voxels [m, world].
struct Corners {
  Eigen::Vector3d low, high;
};

std::optional<Corners> corners_of(const OctomapSummary& octomap) {
  if (!octomap.bounds) return std::nullopt;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * octomap.voxel_m);
  return Corners{centre_of(octomap.bounds->first, octomap.voxel_m) - half,
                 centre_of(octomap.bounds->last, octomap.voxel_m) + half};
}

}  // namespace

std::string octomap_text(const std::string& path, std::uintmax_t bytes,
                         const OctomapSummary& octomap) {
  std::string text = fmt::format(
      "{} ({}): OctoMap, {}\n  voxels     {} occupied, {} free in {} leaves\n  voxel size {} m\n",
      visible(path), size_text(bytes), octomap.kind, octomap.occupied_voxels, octomap.free_voxels,
      octomap.leaves, octomap.voxel_m);
  if (const auto c = corners_of(octomap)) {
    text +=
        fmt::format("  bounds     x {:.2f} .. {:.2f}, y {:.2f} .. {:.2f}, z {:.2f} .. {:.2f} m\n",
                    c->low.x(), c->high.x(), c->low.y(), c->high.y(), c->low.z(), c->high.z());
  }
  return text;
}

std::string octomap_json(const std::string& path, std::uintmax_t bytes,
                         const OctomapSummary& octomap) {
  nlohmann::ordered_json json{
      {"path", path},
      {"bytes", bytes},
      {"format", "OctoMap " + octomap.kind},
      {"voxel_m", octomap.voxel_m},
      {"nodes", octomap.nodes},
      {"leaves", octomap.leaves},
      {"voxels", {{"occupied", octomap.occupied_voxels}, {"free", octomap.free_voxels}}}};
  if (const auto c = corners_of(octomap)) {
    json["bounds_m"] = {{"low", {c->low.x(), c->low.y(), c->low.z()}},
                        {"high", {c->high.x(), c->high.y(), c->high.z()}}};
  }
  return json_text(json) + "\n";
}

nlohmann::ordered_json salvage_json(const SalvageReport& report) {
  nlohmann::ordered_json json{{"kept", report.kept},
                              {"missing", nullptr},
                              {"is_whole", report.is_whole()},
                              {"lines", report.lines()}};
  if (report.missing) json["missing"] = *report.missing;
  return json;
}

}  // namespace swiftlet::app
