// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/object_voxels.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/seeds.hpp"

namespace swiftlet::eval {
namespace {

using HeldVoxels = std::map<VoxelIndex, Holds>;

constexpr VoxelBox kBox{{-20, -20, -20}, {20, 20, 20}};

HeldVoxels held_by(const sim::Object& object, double voxel_m = 0.1) {
  HeldVoxels voxels;
  for_each_held_voxel(object, voxel_m, kBox, [&](const VoxelIndex& v, Holds h) { voxels[v] = h; });
  return voxels;
}

Holds holds(const HeldVoxels& voxels, const VoxelIndex& v) {
  const auto found = voxels.find(v);
  return found == voxels.end() ? Holds::kNothing : found->second;
}

sim::Object rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double diameter_m) {
  return {"rod", sim::Cylinder{from, to, diameter_m}};
}

/// Whether a point [m] lies in a box or a cylinder, so deep, from the definition.
bool is_in(const sim::Object& object, const Eigen::Vector3d& p, double deep_m = 0.0) {
  if (const auto* b = std::get_if<sim::Box>(&object.shape)) {
    const Eigen::Vector3d q = b->R_world_box.conjugate() * (p - b->centre_m);
    return (q.cwiseAbs().array() <= 0.5 * b->size_m.array() - deep_m).all();
  }
  const auto& c = std::get<sim::Cylinder>(object.shape);
  const Eigen::Vector3d axis = (c.to_m - c.from_m).normalized();
  const double along = axis.dot(p - c.from_m);
  const double across = (p - c.from_m - along * axis).norm();
  return along >= deep_m && along <= (c.to_m - c.from_m).norm() - deep_m &&
         across <= 0.5 * c.diameter_m - deep_m;
}

TEST(ObjectVoxels, of_thick_objects_are_solid_where_their_centre_is_inside) {
  test::for_each_seed(40, [](test::Random& random) {
    const bool is_box = random.chance(0.5);
    const sim::Object object =
        is_box ? sim::Object{"box", sim::Box{random.vector(-0.5, 0.5), random.vector(0.15, 1.0),
                                             random.rotation()}}
               : rod(random.vector(-0.8, -0.3), random.vector(0.3, 0.8), random.real(0.15, 0.8));
    const HeldVoxels voxels = held_by(object);
    for (int i = 0; i < 500; ++i) {
      const VoxelIndex v{random.integer(-12, 12), random.integer(-12, 12), random.integer(-12, 12)};
      EXPECT_EQ(holds(voxels, v) == Holds::kSolid, is_in(object, centre_of(v, 0.1), 0.005));
      const Eigen::Vector3d p = centre_of(v, 0.1) + random.vector(-0.0499, 0.0499);
      EXPECT_TRUE(holds(voxels, v) != Holds::kNothing || !is_in(object, p))
          << "a voxel with a point of the object holds some of it";
    }
  });
}

TEST(ObjectVoxels, of_a_box_that_fills_its_voxels_have_no_slivers) {
  const auto voxels =
      held_by({"box", sim::Box{{0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}}});  // [0, 0.2] x [0, 0.4] x ..
  EXPECT_EQ(voxels.size(), 2U * 4U * 6U) << "neighbours that it only touches hold nothing of it";
  for (const auto& [v, h] : voxels) EXPECT_EQ(h, Holds::kSolid);
}

TEST(ObjectVoxels, of_a_thin_rod_are_a_line_one_voxel_wide_without_gaps) {
  test::for_each_seed(60, [](test::Random& random) {
    const Eigen::Vector3d from = random.vector(-1.5, 1.5), to = random.vector(-1.5, 1.5);
    if ((to - from).norm() < 0.5) return;
    const HeldVoxels voxels = held_by(rod(from, to, random.real(0.003, 0.05)));
    for (double t = 0.0; t <= 1.0; t += 0.01) {
      const VoxelIndex on_axis = voxel_containing(from + t * (to - from), 0.1);
      EXPECT_NE(holds(voxels, on_axis), Holds::kNothing);
      bool is_near = false;
      for (int i = 0; i < 27; ++i) {
        const VoxelIndex n{on_axis.x + i % 3 - 1, on_axis.y + i / 3 % 3 - 1, on_axis.z + i / 9 - 1};
        is_near = is_near || holds(voxels, n) == Holds::kSolid;
      }
      EXPECT_TRUE(is_near);
    }
    for (const auto& [v, h] : voxels) {
      if (h != Holds::kSolid) continue;
      const GridRay axis{from / 0.1, to / 0.1};
      EXPECT_FALSE(clip_to_box(axis, {v, v}).is_empty()) << "solid voxels are on the axis";
    }
  });
}

TEST(ObjectVoxels, of_a_thin_board_are_one_layer) {
  // 2 cm thick, in the middle of a layer of voxels of 10 cm, where no centre is needed to be.
  const auto voxels = held_by({"board", sim::Box{{0.5, 0.5, 0.07}, {1.0, 1.0, 0.02}}});
  std::size_t solid = 0;
  for (const auto& [v, h] : voxels) {
    solid += h == Holds::kSolid ? 1 : 0;
    if (h == Holds::kSolid) {
      EXPECT_EQ(v.z, 0);
    }
  }
  EXPECT_EQ(solid, 100U);
}

TEST(ObjectVoxels, of_a_plane_between_two_layers_are_those_behind_it) {
  const sim::Object ground{"ground", sim::Plane{{0, 0, 0}, {0, 0, 1}, 60.0}};
  const HeldVoxels voxels = held_by(ground);
  EXPECT_EQ(holds(voxels, {3, -4, -1}), Holds::kSolid);
  EXPECT_EQ(holds(voxels, {3, -4, 0}), Holds::kNothing);
  const sim::Object ceiling{"ceiling", sim::Plane{{0, 0, 0}, {0, 0, -1}, 60.0}};
  EXPECT_EQ(holds(held_by(ceiling), {3, -4, 0}), Holds::kSolid);
}

TEST(ObjectVoxels, of_a_mesh_are_those_its_triangles_run_through) {
  sim::TriangleMesh mesh{
      {{0.05F, 0.05F, 0.05F}, {0.95F, 0.05F, 0.05F}, {0.05F, 0.95F, 0.05F}}, {{0, 1, 2}}, {0}};
  const HeldVoxels voxels = held_by({"sheet", mesh});
  EXPECT_EQ(holds(voxels, {4, 0, 0}), Holds::kSolid);
  EXPECT_EQ(holds(voxels, {2, 2, 0}), Holds::kSolid);
  EXPECT_EQ(holds(voxels, {8, 8, 0}), Holds::kNothing) << "the other half of the square";
  for (const auto& [v, h] : voxels) EXPECT_EQ(v.z, 0);
}

}  // namespace
}  // namespace swiftlet::eval
