// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
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

/// How many triangles append_triangles() would append, and how many a scene may have: a hundred
/// bytes of a scene file can stand for two thousand.
[[nodiscard]] std::size_t triangle_count(const Object& object);
inline constexpr std::size_t kMaxTriangles = 5'000'000;
[[nodiscard]] std::string too_many_triangles();
inline constexpr const char* kFewerTriangles = "leave objects out or use coarser meshes";

/// Whether all lie within 2000 km of the origin: twice as far as a scene file can place things,
/// since movers add their own way. NaN lies nowhere.
[[nodiscard]] bool is_within_reach(std::span<const Eigen::Vector3f> points_m);

}  // namespace swiftlet::sim
