// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_OCTOMAP

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "swiftlet/file/output_file.hpp"
#include "swiftlet/store/export/exporters.hpp"
#include "swiftlet/store/export/reported_voxels.hpp"

namespace swiftlet {
namespace {

/// OctoMap's key of a voxel: both grids have a voxel face at the origin, so only the offset
/// differs.
constexpr std::int32_t kKeyOffset = 32768;

bool has_key(const VoxelIndex& v) {
  const auto fits = [](std::int32_t i) { return i >= -kKeyOffset && i < kKeyOffset; };
  return fits(v.x) && fits(v.y) && fits(v.z);
}

octomap::OcTreeKey key_of(const VoxelIndex& v) {
  const auto key = [](std::int32_t i) { return static_cast<octomap::key_type>(i + kKeyOffset); };
  return {key(v.x), key(v.y), key(v.z)};
}

/// The voxel's log-odds, with the sign of its state: OctoMap takes what is >= 0 for occupied, ours
/// has two thresholds.
float octomap_logodds(QuantizedLogOdds voxel, Occupancy state, float per_step) {
  const float value = static_cast<float>(voxel - kUnknownVoxel) * per_step;
  return state == Occupancy::kOccupied ? std::max(value, per_step) : std::min(value, -per_step);
}

Expected<std::unique_ptr<octomap::OcTree>> build_tree(const SavedMap& map,
                                                      const std::filesystem::path& out,
                                                      const ExportProgress& progress) {
  auto tree = std::make_unique<octomap::OcTree>(map.voxel_m());
  const auto per_step = static_cast<float>(map.header().scale.logodds_per_step);
  tree->setClampingThresMin(1e-4);  // wider than our bytes, so that it clamps nothing
  tree->setClampingThresMax(1.0 - 1e-4);
  bool fits = true;
  auto passed = for_each_known_voxel(
      map, progress, [&](const VoxelIndex& v, QuantizedLogOdds voxel, Occupancy state) {
        fits = fits && has_key(v);
        if (!fits) return;
        tree->setNodeValue(key_of(v), octomap_logodds(voxel, state, per_step), true);
      });
  if (!passed) return forward_error(std::move(passed));
  if (!fits) {
    return fail(ErrorCode::kUnsupported, out.string(),
                "the map reaches beyond the 65536 voxels along each axis that OctoMap has",
                "export it as ply or pcd");
  }
  tree->updateInnerOccupancy();
  return tree;
}

/// What AbstractOcTree::write() would put first; that function also prints, and rounds the voxel
/// size to six digits.
std::string header(std::string_view first_line, const octomap::OcTree& tree) {
  return fmt::format(
      "{}\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
      "id {}\nsize {}\nres {}\ndata\n",
      first_line, tree.getTreeType(), tree.size(), tree.getResolution());
}

}  // namespace

Status export_bt(const SavedMap& map, const std::filesystem::path& out,
                 const ExportProgress& progress) {
  auto tree = build_tree(map, out, progress);
  if (!tree) return forward_error(std::move(tree));
  (*tree)->toMaxLikelihood();  // reduces each voxel to free or occupied
  (*tree)->prune();
  auto file = OutputFile::create(out, std::array{map.path()});
  if (!file) return forward_error(std::move(file));
  file->write(header("# Octomap OcTree binary file", **tree));
  if ((*tree)->size() > 0) (*tree)->writeBinaryNode(file->stream(), (*tree)->getRoot());
  return file->commit();
}

Status export_ot(const SavedMap& map, const std::filesystem::path& out,
                 const ExportProgress& progress) {
  auto tree = build_tree(map, out, progress);
  if (!tree) return forward_error(std::move(tree));
  (*tree)->prune();  // joins eight equal voxels only
  auto file = OutputFile::create(out, std::array{map.path()});
  if (!file) return forward_error(std::move(file));
  file->write(header("# Octomap OcTree file", **tree));
  if ((*tree)->size() > 0) (*tree)->writeData(file->stream());
  return file->commit();
}

}  // namespace swiftlet

#endif
