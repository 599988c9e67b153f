// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/grid_ray.hpp"

namespace swiftlet {

/// Writes the voxels of a ray that lie in the box, in order from `from` to `to`, and returns how
/// many there are. REQUIRES: out holds at least max_voxels(box); all coordinates are finite and
/// within +-2^30.
using TraceRay = std::size_t (*)(const GridRay& ray, const VoxelBox& box,
                                 std::span<VoxelIndex> out);

/// A ray can cross no more voxels of a box than this.
[[nodiscard]] constexpr std::size_t max_voxels(const VoxelBox& box) {
  const auto side = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::size_t>(b - a) + 2;
  };
  return side(box.first.x, box.last.x) + side(box.first.y, box.last.y) +
         side(box.first.z, box.last.z);
}

/// One line of the table of ray methods.
struct RayMethod {
  std::string_view name;
  std::string_view summary;
  TraceRay trace;
  bool is_exact;  ///< visits every voxel that the segment crosses, not only some of them
};

[[nodiscard]] std::span<const RayMethod> ray_methods();

/// Errors: kUsage for an unknown name, naming those there are.
[[nodiscard]] Expected<RayMethod> find_ray_method(std::string_view name);

}  // namespace swiftlet
