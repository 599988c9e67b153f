// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/movers.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/eval/truth/object_voxels.hpp"

namespace swiftlet::eval {
namespace {

using ToWorld = Transform<World, sim::Flyer>;

void move(sim::Box& box, const ToWorld& T) {
  box.centre_m = T * box.centre_m;
  box.R_world_box = T.rotation() * box.R_world_box;
}
void move(sim::Cylinder& cylinder, const ToWorld& T) {
  cylinder.from_m = T * cylinder.from_m;
  cylinder.to_m = T * cylinder.to_m;
}
void move(sim::Plane& plane, const ToWorld& T) {
  plane.centre_m = T * plane.centre_m;
  plane.normal = T.rotation() * plane.normal;
}
void move(sim::TriangleMesh& mesh, const ToWorld& T) {
  for (Eigen::Vector3f& p : mesh.vertices_m) p = (T * p.cast<double>()).cast<float>();
}

}  // namespace

std::vector<sim::Object> movers_at(const sim::Scene& scene, Nanoseconds since_start) {
  std::vector<sim::Object> moved;
  for (const sim::Mover& mover : scene.movers) {
    const auto T_world_mover = mover.path.at(since_start);
    for (sim::Object object : mover.objects) {
      std::visit([&](auto& shape) { move(shape, T_world_mover); }, object.shape);
      moved.push_back(std::move(object));
    }
  }
  return moved;
}

std::vector<VoxelIndex> swept_voxels(const sim::Scene& scene, double voxel_m, const VoxelBox& box) {
  constexpr Nanoseconds kStep = std::chrono::milliseconds(50);
  if (scene.movers.empty()) return {};
  DenseGrid<std::uint8_t> is_swept(box, 0);
  const auto mark = [&](const VoxelIndex& v) {
    if (box.contains(v)) is_swept.at(v) = 1;
    return false;  // go on
  };
  for (Nanoseconds t{0}; t <= scene.flight.duration(); t += kStep) {
    for (const sim::Object& object : movers_at(scene, t)) {
      for_each_held_voxel(object, voxel_m, box,
                          [&](const VoxelIndex& v, Holds) { (void)any_within(v, 1, mark); });
    }
  }
  std::vector<VoxelIndex> swept;
  is_swept.for_each([&](const VoxelIndex& v, std::uint8_t mark_of_voxel) {
    if (mark_of_voxel != 0) swept.push_back(v);
  });
  return swept;
}

void see_movers(const std::vector<sim::Object>& movers, std::span<const SightLine> lines,
                double voxel_m, MoverSights& sights) {
  std::ranges::fill(sights.voxels(), MoverSight::kNothing);
  DenseGrid<Holds> held(sights.box(), Holds::kNothing);
  for (const sim::Object& object : movers) {
    for_each_held_voxel(object, voxel_m, sights.box(), [&](const VoxelIndex& v, Holds holds) {
      held.at(v) = std::max(held.at(v), holds);
    });
  }
  for (const SightLine& line : lines) {
    const Eigen::Vector3d eye = line.eye_m.cast<double>() / voxel_m;
    const Eigen::Vector3d point = line.point_m.cast<double>() / voxel_m;
    const Eigen::Vector3d deeper = point + 0.25 * (point - eye).normalized();
    const GridRay ray{eye, deeper};
    const Clip clip = clip_to_box(ray, sights.box());
    if (clip.is_empty()) continue;
    const VoxelIndex end = voxel_containing(deeper, 1.0);
    GridWalk walk(ray, sights.box(), clip);
    do {
      const VoxelIndex v = walk.voxel();
      if (v == end) {
        if (held.at(v) == Holds::kSolid) sights.at(v) = MoverSight::kMatter;
      } else if (held.at(v) == Holds::kNothing) {
        sights.at(v) = MoverSight::kLookedThrough;
      }
    } while (walk.advance());
  }
}

}  // namespace swiftlet::eval
