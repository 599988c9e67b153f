// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {
namespace {

std::uint32_t sides_of(const Cylinder& cylinder) {
  constexpr std::uint32_t kLeast = 16;
  const double radius_m = 0.5 * cylinder.diameter_m;
  if (!(radius_m > 0.0)) return kLeast;  // a fault of the scene that is told elsewhere
  const double half_angle = std::acos(std::max(0.0, 1.0 - kMaxSagitta_m / radius_m));
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(std::numbers::pi / half_angle), double{kLeast}, 512.0));
}

/// Adds the vertices and triangles of one object, numbered from 0, to a mesh that has others.
class Appender {
 public:
  Appender(TriangleMesh& mesh, std::uint16_t material)
      : mesh_(mesh),
        material_(material),
        first_(static_cast<std::uint32_t>(mesh.vertices_m.size())) {}

  void vertex(const Eigen::Vector3d& p_m) { mesh_.vertices_m.emplace_back(p_m.cast<float>()); }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({first_ + a, first_ + b, first_ + c});
    mesh_.materials.push_back(material_);
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  void operator()(const Box& box) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sign((corner & 1U) != 0U ? 0.5 : -0.5, (corner & 2U) != 0U ? 0.5 : -0.5,
                                 (corner & 4U) != 0U ? 0.5 : -0.5);
      vertex(box.centre_m + box.R_world_box * sign.cwiseProduct(box.size_m));
    }
    quad(0, 2, 6, 4);
    quad(1, 5, 7, 3);
    quad(0, 4, 5, 1);
    quad(2, 3, 7, 6);
    quad(0, 1, 3, 2);
    quad(4, 6, 7, 5);
  }

  void operator()(const Plane& plane) {
    const Eigen::Quaterniond R =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), plane.normal);
    const double half = 0.5 * plane.side_m;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      vertex(plane.centre_m + R * Eigen::Vector3d(x * half, y * half, 0.0));
    quad(0, 1, 2, 3);
  }

  void operator()(const Cylinder& cylinder) {
    const Eigen::Vector3d axis = cylinder.to_m - cylinder.from_m;
    const Eigen::Quaterniond R = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis);
    const double radius_m = 0.5 * cylinder.diameter_m;
    const std::uint32_t sides = sides_of(cylinder);
    // Corners as far outside the circle as the middles of the sides are inside.
    const double corner_m = 2.0 * radius_m / (1.0 + std::cos(std::numbers::pi / sides));

    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const Eigen::Vector3d rim(corner_m * std::cos(angle), corner_m * std::sin(angle), 0.0);
      vertex(cylinder.from_m + R * rim);
      vertex(cylinder.to_m + R * rim);
    }
    vertex(cylinder.from_m);
    vertex(cylinder.to_m);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t low = 2 * i;
      const std::uint32_t next = 2 * ((i + 1) % sides);
      quad(low, next, next + 1, low + 1);
      triangle(2 * sides, next, low);
      triangle(2 * sides + 1, low + 1, next + 1);
    }
  }

  void operator()(const TriangleMesh& other) {
    mesh_.vertices_m.insert(mesh_.vertices_m.end(), other.vertices_m.begin(),
                            other.vertices_m.end());
    for (const auto& [a, b, c] : other.triangles) triangle(a, b, c);
  }

 private:
  TriangleMesh& mesh_;
  std::uint16_t material_;
  std::uint32_t first_;
};

}  // namespace

void append_triangles(const Object& object, TriangleMesh& mesh) {
  std::visit(Appender(mesh, object.material), object.shape);
}

std::size_t triangle_count(const Object& object) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&object.shape)) return mesh->triangles.size();
  if (const auto* cylinder = std::get_if<Cylinder>(&object.shape))
    return std::size_t{4} * sides_of(*cylinder);
  return std::holds_alternative<Box>(object.shape) ? 12 : 2;
}

std::string too_many_triangles() {
  return fmt::format("the scene has more than {} triangles", kMaxTriangles);
}

bool is_within_reach(std::span<const Eigen::Vector3f> points_m) {
  constexpr float kReach_m = 2e6F;
  return std::ranges::all_of(points_m, [](const Eigen::Vector3f& p) {
    return p.cwiseAbs().maxCoeff() <= kReach_m && p.allFinite();
  });
}

}  // namespace swiftlet::sim
