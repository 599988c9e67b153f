// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/map/log_odds.hpp"

namespace swiftlet {

/// A leaf of an OctoMap tree: a cube of voxels of one state.
struct OctomapLeaf {
  VoxelIndex first;
  std::int32_t edge = 1;  ///< voxels along each axis: a power of two, up to 65536
  bool is_occupied = false;
  float log_odds = 0.0F;  ///< .ot only

  [[nodiscard]] std::uint64_t voxels() const {
    const auto n = static_cast<std::uint64_t>(edge);
    return n * n * n;
  }
};

/// What an OctoMap file holds.
struct OctomapSummary {
  std::string kind;  ///< "OcTree", "ColorOcTree"
  double voxel_m = 0.0;
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint64_t free_voxels = 0;  ///< of the finest size
  std::uint64_t occupied_voxels = 0;
  std::optional<VoxelBox> bounds;
};

using VisitLeaf = std::function<void(const OctomapLeaf&)>;

/// Reads a .bt or .ot file, the kind being told by its first line. Our own reader, for files from
/// anywhere: it needs no OctoMap, and a damaged file is an error, never a crash.
/// Errors: kNotFound, kCorruptInput, kUnsupported for trees other than OcTree and ColorOcTree.
[[nodiscard]] Expected<OctomapSummary> read_octomap(const std::filesystem::path& path,
                                                    const VisitLeaf& visit = {});

}  // namespace swiftlet
