// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/vehicle/triangle_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

double distance_to_segment(const Vector3d& p, const Segment3d& s) {
  const Vector3d along = s[1] - s[0];
  const double length_2 = along.squaredNorm();
  const double t = length_2 > 0.0 ? std::clamp(along.dot(p - s[0]) / length_2, 0.0, 1.0) : 0.0;
  return (p - s[0] - t * along).norm();
}

double distance_to_edges(const Vector3d& p, const Triangle3d& t) {
  return std::min({distance_to_segment(p, {t[0], t[1]}), distance_to_segment(p, {t[1], t[2]}),
                   distance_to_segment(p, {t[2], t[0]})});
}

/// Whether the foot of a point on the plane of a triangle lies in the triangle.
bool is_over(const Vector3d& p, const Triangle3d& t, const Vector3d& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d edge = t[(i + 1) % 3] - t[i];
    if (normal.dot(edge.cross(p - t[i])) < 0.0) return false;
  }
  return true;
}

bool crosses(const Segment3d& s, const Triangle3d& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double above_0 = normal.dot(s[0] - t[0]), above_1 = normal.dot(s[1] - t[0]);
  if (above_0 * above_1 > 0.0 || above_0 == above_1) return false;  // one side, or parallel
  return is_over(s[0] + above_0 / (above_0 - above_1) * (s[1] - s[0]), t, normal);
}

}  // namespace

double distance(const Vector3d& point, const Triangle3d& triangle) {
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double area = normal.norm();
  if (area > 0.0 && is_over(point, triangle, normal))
    return std::abs(normal.dot(point - triangle[0])) / area;
  return distance_to_edges(point, triangle);
}

double distance(const Segment3d& a, const Segment3d& b) {
  const Vector3d u = a[1] - a[0], v = b[1] - b[0], w = a[0] - b[0];
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  // The nearest points of two segments are inside both, or one of them is an end.
  double least = std::min({distance_to_segment(a[0], b), distance_to_segment(a[1], b),
                           distance_to_segment(b[0], a), distance_to_segment(b[1], a)});
  if (determinant > 0.0) {
    const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
    const double t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
      least = std::min(least, (w + s * u - t * v).norm());
  }
  return least;
}

double distance(const Segment3d& segment, const Triangle3d& triangle) {
  if (crosses(segment, triangle)) return 0.0;
  double least = std::min(distance(segment[0], triangle), distance(segment[1], triangle));
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, distance(segment, Segment3d{triangle[i], triangle[(i + 1) % 3]}));
  return least;
}

double distance(const Triangle3d& a, const Triangle3d& b) {
  double least = distance(Segment3d{a[0], a[1]}, b);
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, distance(Segment3d{a[i], a[(i + 1) % 3]}, b),
                      distance(Segment3d{b[i], b[(i + 1) % 3]}, a)});
  }
  return least;
}

}  // namespace swiftlet::sim
