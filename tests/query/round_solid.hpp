// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "support/seeds.hpp"
#include "swiftlet/query/sweep/body_shape.hpp"

namespace swiftlet::test {

/// A body as the test understands it: a box with round edges. A sphere has no size, a capsule is
/// long along one axis alone, a box has no radius.
struct Solid {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  double radius = 0.0;

  [[nodiscard]] BodyShape shape() const {
    if (half.isZero()) return *BodyShape::sphere(radius, centre);
    if (radius == 0.0)
      return *BodyShape::box(2.0 * half, Transform<Body, Body>::trusted(attitude, centre));
    const Eigen::Vector3d along = attitude * half;
    return *BodyShape::capsule(centre - along, centre + along, radius);
  }
};

inline Solid random_solid(Random& random) {
  Solid solid;
  if (random.chance(0.5)) solid.centre = random.vector(-0.3, 0.3);
  solid.attitude = random.chance(0.3) ? Eigen::Quaterniond::Identity() : random.rotation();
  const int kind = random.integer(0, 2);
  if (kind == 1) solid.half.x() = random.real(0.01, 0.5);
  if (kind == 2) solid.half = random.vector(0.005, 0.3);
  if (kind != 2) solid.radius = random.real(0.005, 0.35);
  return solid;
}

/// A solid at its place.
struct Placed {
  Placed(const Solid& solid, const Transform<World, Body>& T)
      : R((T.rotation() * solid.attitude).toRotationMatrix()),
        centre(T * solid.centre),
        half(solid.half),
        radius(solid.radius) {}

  Eigen::Matrix3d R;
  Eigen::Vector3d centre;
  Eigen::Vector3d half;
  double radius;
};

/// Distance from the cube [low, low + a voxel]: between the nearest points of the inner box and the
/// cube, found by going from one to the other and back. From above.
inline double gap_by_hand(const Placed& solid, const Eigen::Vector3d& low, double voxel_m) {
  const Eigen::Vector3d high = low + Eigen::Vector3d::Constant(voxel_m);
  Eigen::Vector3d on_cube = 0.5 * (low + high);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d seen = solid.R.transpose() * (on_cube - solid.centre);
    const Eigen::Vector3d on_box =
        solid.centre + solid.R * seen.cwiseMax(-solid.half).cwiseMin(solid.half);
    on_cube = on_box.cwiseMax(low).cwiseMin(high);
    const double now = (on_box - on_cube).norm();
    if (now <= solid.radius) return 0.0;
    if (now > before - 1e-12) break;
    before = now;
  }
  return before - solid.radius;
}

}  // namespace swiftlet::test
