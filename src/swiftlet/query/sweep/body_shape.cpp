// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/sweep/body_shape.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

// Larger than any vehicle and any window; keeps squares of lengths finite.
constexpr double kLargest_m = 1e6;

/// The farthest corner of a part's edges from the origin [m].
double lever_of(const BodyShape::Part& part) {
  double lever_m = 0.0;
  for (unsigned signs = 0; signs < 1U << static_cast<unsigned>(part.edge_count); ++signs) {
    Eigen::Vector3d corner_m = part.centre_m;
    for (int i = 0; i < part.edge_count; ++i) {
      const bool is_plus = (signs >> static_cast<unsigned>(i) & 1U) != 0;
      corner_m += (is_plus ? 1.0 : -1.0) * part.half_edges_m[static_cast<std::size_t>(i)];
    }
    lever_m = std::max(lever_m, corner_m.norm());
  }
  return lever_m;
}

bool is_measure(double v) { return v >= 0.0 && v <= kLargest_m; }  // false for NaN, too

}  // namespace

void BodyShape::add(const Part& part) {
  parts_.push_back(part);
  lever_m_ = std::max(lever_m_, lever_of(part));
  reach_m_ = std::max(reach_m_, lever_of(part) + part.radius_m);
}

Expected<BodyShape> BodyShape::of(const Part& part) {
  bool is_sound = is_measure(part.radius_m) && is_measure(part.centre_m.norm());
  for (int i = 0; i < part.edge_count; ++i)
    is_sound = is_sound && is_measure(part.half_edges_m[static_cast<std::size_t>(i)].norm());
  if (!is_sound) {
    return fail(ErrorCode::kUsage, "body", "a size or a place of the body cannot be used",
                "give finite numbers, sizes not below 0, in metres");
  }
  BodyShape shape;
  shape.add(part);
  return shape;
}

Expected<BodyShape> BodyShape::sphere(double radius_m, const Eigen::Vector3d& centre_m) {
  return of({centre_m, {}, 0, radius_m});
}

Expected<BodyShape> BodyShape::capsule(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m,
                                       double radius_m) {
  return of({0.5 * (from_m + to_m), {Eigen::Vector3d(0.5 * (to_m - from_m))}, 1, radius_m});
}

Expected<BodyShape> BodyShape::box(const Eigen::Vector3d& size_m,
                                   const Transform<Body, Body>& T_body_box) {
  if (!(size_m.array() >= 0.0).all()) {
    return fail(ErrorCode::kUsage, "body", "an edge of the box is negative or no number",
                "give three lengths in metres");
  }
  const Eigen::Matrix3d axes = T_body_box.rotation().toRotationMatrix();
  Part part{T_body_box.translation(), {}, 3, 0.0};
  for (int i = 0; i < 3; ++i)
    part.half_edges_m[static_cast<std::size_t>(i)] = 0.5 * size_m[i] * axes.col(i);
  return of(part);
}

Expected<BodyShape> BodyShape::united(std::span<const BodyShape> shapes) {
  if (shapes.empty())
    return fail(ErrorCode::kUsage, "body", "a union of no shapes", "give at least one");
  BodyShape whole;
  for (const BodyShape& shape : shapes) {
    for (const Part& part : shape.parts_) whole.add(part);
  }
  return whole;
}

}  // namespace swiftlet
