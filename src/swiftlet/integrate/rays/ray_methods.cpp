// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/integrate/rays/ray_method.hpp"

// A ray method is one file, which ends in trace_<name>(), and one line here: name, is_exact,
// summary.
#define SWIFTLET_RAY_METHODS(X)                                                    \
  X(voxel_traversal, true,                                                         \
    "every voxel the ray crosses, face by face; the reference (Amanatides & Woo)") \
  X(line_drawing, false,                                                           \
    "one voxel per step along the longest axis; skips corners, a little faster")

namespace swiftlet {

#define SWIFTLET_DECLARE(name, is_exact, summary) \
  std::size_t trace_##name(const GridRay& ray, const VoxelBox& box, std::span<VoxelIndex> out);
SWIFTLET_RAY_METHODS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const RayMethod> ray_methods() {
#define SWIFTLET_LINE(name, is_exact, summary) RayMethod{#name, summary, trace_##name, is_exact},
  static constexpr std::array kMethods{SWIFTLET_RAY_METHODS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kMethods;
}

Expected<RayMethod> find_ray_method(std::string_view name) {
  return find_registered(ray_methods(), name, "ray method");
}

}  // namespace swiftlet
