// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/vehicle/true_clearance.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "swiftlet/sim/vehicle/triangle_distance.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

/// A part of a body where it is: the corners that its edges span, counted in binary.
struct PlacedPart {
  std::array<Vector3d, 8> corners{};
  int edge_count;
  double radius_m;

  PlacedPart(const BodyShape::Part& part, const Transform<World, Body>& T_world_body)
      : edge_count(part.edge_count), radius_m(part.radius_m) {
    for (std::size_t corner = 0; corner < (std::size_t{1} << edge_count); ++corner) {
      Vector3d p_body = part.centre_m;
      for (std::size_t edge = 0; edge < static_cast<std::size_t>(edge_count); ++edge)
        p_body += ((corner >> edge & 1U) != 0U ? 1.0 : -1.0) * part.half_edges_m[edge];
      corners[corner] = T_world_body * p_body;
    }
  }

  /// Whether a point lies within the box that three edges span.
  [[nodiscard]] bool holds(const Vector3d& p_world) const {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = corners[std::size_t{1} << i] - corners[0];
    const Vector3d share = edges.inverse() * (p_world - corners[0]);
    return share.minCoeff() >= 0.0 && share.maxCoeff() <= 1.0;
  }

  [[nodiscard]] double distance_to(const Triangle3d& triangle) const {
    if (edge_count == 0) return distance(corners[0], triangle) - radius_m;
    if (edge_count == 1) return distance(Segment3d{corners[0], corners[1]}, triangle) - radius_m;
    constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
        {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}}};
    const std::size_t faces = edge_count == 2 ? 1 : kFaces.size();
    if (edge_count == 3 && holds(triangle[0])) return -radius_m;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c, d] : std::span(kFaces).first(faces)) {
      least = std::min({least, distance(Triangle3d{corners[a], corners[b], corners[c]}, triangle),
                        distance(Triangle3d{corners[a], corners[c], corners[d]}, triangle)});
    }
    return least - radius_m;
  }
};

/// Whether a point lies in the matter of an object; sheets and meshes have none.
bool is_inside(const Object& object, const Vector3d& p) {
  if (const auto* box = std::get_if<Box>(&object.shape)) {
    const Vector3d p_box = box->R_world_box.conjugate() * (p - box->centre_m);
    return (p_box.cwiseAbs().array() <= 0.5 * box->size_m.array()).all();
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&object.shape)) {
    const Vector3d axis = cylinder->to_m - cylinder->from_m;
    const double share = axis.dot(p - cylinder->from_m) / axis.squaredNorm();
    return share >= 0.0 && share <= 1.0 &&
           (p - cylinder->from_m - share * axis).norm() <= 0.5 * cylinder->diameter_m;
  }
  return false;
}

bool is_inside_any(const Scene& scene, Nanoseconds now, const Vector3d& p_world) {
  const auto holds = [](const std::vector<Object>& objects, const Vector3d& p) {
    return std::ranges::any_of(objects, [&](const Object& o) { return is_inside(o, p); });
  };
  return holds(scene.objects, p_world) || std::ranges::any_of(scene.movers, [&](const Mover& m) {
           return holds(m.objects, m.path.at(now).inverse() * p_world);
         });
}

// Rounding to floats in the search must not lose the nearest triangle.
constexpr double kRounding_m = 1e-4;

}  // namespace

TrueClearance::TrueClearance(Scene scene, BodyShape body, RayCaster world)
    : scene_(std::move(scene)), body_(std::move(body)), world_(std::move(world)) {}

Expected<TrueClearance> TrueClearance::create(const Scene& scene, const BodyShape& body) {
  auto world = RayCaster::create(scene);
  if (!world) return forward_error(std::move(world));
  return TrueClearance(scene, body, std::move(*world));
}

void TrueClearance::move_to(Nanoseconds since_start) {
  now_ = since_start;
  world_.move_to(since_start);
}

double TrueClearance::clearance_m(const Transform<World, Body>& T_world_body,
                                  double within_m) const {
  std::vector<PlacedPart> parts;
  for (const BodyShape::Part& part : body_.parts()) {
    if (is_inside_any(scene_, now_, T_world_body * part.centre_m)) return 0.0;
    parts.emplace_back(part, T_world_body);
  }
  double least_m = within_m;
  const auto radius = [&] { return static_cast<float>(least_m + body_.reach_m() + kRounding_m); };
  world_.search_near(T_world_body.translation().cast<float>(), radius(), [&](const Triangle& t) {
    const Triangle3d triangle = in_double(t);
    for (const PlacedPart& part : parts)
      least_m = std::max(0.0, std::min(least_m, part.distance_to(triangle)));
    return least_m > 0.0 ? radius() : 0.0F;
  });
  return least_m;
}

double TrueClearance::distance_m(const Vector3d& p_world, double within_m) const {
  if (is_inside_any(scene_, now_, p_world)) return 0.0;
  double least_m = within_m;
  const auto radius = [&] { return static_cast<float>(least_m + kRounding_m); };
  world_.search_near(p_world.cast<float>(), radius(), [&](const Triangle& t) {
    least_m = std::min(least_m, distance(p_world, in_double(t)));
    return radius();
  });
  return least_m;
}

}  // namespace swiftlet::sim
