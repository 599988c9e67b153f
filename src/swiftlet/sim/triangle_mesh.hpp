// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace swiftlet::sim {

/// Triangles with one material each. Vertices in metres; both faces of a triangle are solid.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> materials;  ///< one per triangle: index into Scene::materials
};

struct Object;

/// Appends the triangles of an object. A cylinder becomes a prism with so many sides that its
/// surface stays within kMaxSagitta_m / 2 of the true one.
inline constexpr double kMaxSagitta_m = 2e-4;
void append_triangles(const Object& object, TriangleMesh& mesh);

}  // namespace swiftlet::sim
