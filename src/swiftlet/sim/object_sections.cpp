// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/sim/ply_reader.hpp"
#include "swiftlet/sim/scene_sections_private.hpp"

namespace swiftlet::sim {
namespace {

using Shape = decltype(Object::shape);

Eigen::Quaterniond read_rotation(YamlSection& entry) {
  const auto angle = [&](std::string_view key) {
    return radians(entry.number(key, kAnyNumber, 0.0));
  };
  const double yaw = angle("yaw_deg");
  const double pitch = angle("pitch_deg");
  return rotation_from_ypr(yaw, pitch, angle("roll_deg"));
}

/// Either two opposite corners (walls) or a centre and a size (things that stand freely).
Shape read_box(YamlSection& entry) {
  const bool by_corners = entry.has("from_m") || entry.has("to_m");
  const bool by_size = entry.has("centre_m") || entry.has("size_m");
  if (by_corners == by_size)
    entry.problem("a box needs either from_m and to_m, or centre_m and size_m");
  Box box{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), read_rotation(entry)};
  if (by_corners) {
    const Eigen::Vector3d from = entry.vector("from_m");
    const Eigen::Vector3d to = entry.vector("to_m");
    box.centre_m = 0.5 * (from + to);
    box.size_m = to - from;
  } else {
    box.centre_m = entry.vector("centre_m");
    box.size_m = entry.vector("size_m");
  }
  if (!(box.size_m.minCoeff() > 0.0))
    entry.problem("every side of a box must be longer than 0", "size_m and to_m - from_m count");
  return box;
}

Shape read_cylinder(YamlSection& entry) {
  const Cylinder cylinder{entry.vector("from_m"), entry.vector("to_m"),
                          entry.number("diameter_m", kLength)};
  if (!((cylinder.to_m - cylinder.from_m).norm() > 0.0))
    entry.problem("a cylinder must be longer than 0");
  return cylinder;
}

Shape read_plane(YamlSection& entry) {
  const Plane plane{entry.vector("centre_m"), entry.vector("normal"),
                    entry.number("side_m", kLength, 200.0)};
  if (!(plane.normal.norm() > 0.0)) entry.problem("the normal of a plane must not be zero");
  return plane;
}

Shape read_mesh(YamlSection& entry, const std::string& folder) {
  const auto path = std::filesystem::path(folder) / entry.text("file");
  const Eigen::Vector3d at_m = entry.vector("at_m", Eigen::Vector3d::Zero());
  const double scale = entry.number("scale", kLength, 1.0);
  const Eigen::Quaterniond R = read_rotation(entry);
  auto mesh = read_ply(path.string());
  if (!mesh) {
    entry.problem(mesh.error().text());
    return TriangleMesh{};
  }
  for (Eigen::Vector3f& p : mesh->vertices_m)
    p = (R * (scale * p.cast<double>()) + at_m).cast<float>();
  if (!is_within_reach(mesh->vertices_m))
    entry.problem("the mesh has corners more than 1000 km away", "check its unit and 'scale'");
  return *std::move(mesh);
}

std::uint16_t read_material(YamlSection& entry, const std::vector<Material>& materials) {
  const std::string name = entry.text("material", materials.front().name);
  const auto found = std::ranges::find(materials, name, &Material::name);
  if (found != materials.end()) return to<std::uint16_t>(found - materials.begin());
  std::vector<std::string> names;
  names.reserve(materials.size());
  for (const auto& material : materials) names.push_back(material.name);
  entry.problem(fmt::format("unknown material '{}'", name),
                fmt::format("known are: {}", fmt::join(names, ", ")));
  return 0;
}

}  // namespace

std::vector<Object> ObjectReader::read(YamlSection& parent) {
  std::vector<Object> objects;
  const auto read_all = [&](std::string_view key, auto read_shape) {
    for (YamlSection& entry : parent.list(key)) {
      if (triangles > kMaxTriangles) return;
      Object object{entry.text("name", ""), read_shape(entry), read_material(entry, materials)};
      triangles += triangle_count(object);
      if (triangles > kMaxTriangles) entry.problem(too_many_triangles(), kFewerTriangles);
      objects.push_back(std::move(object));
      entry.finish();
    }
  };
  read_all("boxes", read_box);
  read_all("cylinders", read_cylinder);
  read_all("planes", read_plane);
  read_all("meshes", [this](YamlSection& entry) { return read_mesh(entry, folder); });
  return objects;
}

}  // namespace swiftlet::sim
