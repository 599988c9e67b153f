// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/query/sweep/body_shape.hpp"
#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

/// How much room a body truly has in a scene, whatever any map says: the judge of a flight.
/// Exact for the triangles that the camera sees, too; what is inside a box or a cylinder has none.
/// Thread safety: questions from many threads; move_to() needs the object alone.
class TrueClearance {
 public:
  /// Errors: those of RayCaster::create().
  [[nodiscard]] static Expected<TrueClearance> create(const Scene& scene, const BodyShape& body);

  /// Puts the movers where they are at a time since the scene's start.
  void move_to(Nanoseconds since_start);

  /// Distance [m] from the body to the nearest surface: 0 if they touch or the body is inside
  /// something, `within_m` if nothing is as near. Cost: microseconds.
  [[nodiscard]] double clearance_m(const Transform<World, Body>& T_world_body,
                                   double within_m = 5.0) const;
  [[nodiscard]] bool collides(const Transform<World, Body>& T_world_body) const {
    return clearance_m(T_world_body, 1e-6) <= 0.0;
  }
  /// The same of a point, without the body.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& p_world, double within_m = 5.0) const;

 private:
  TrueClearance(Scene scene, BodyShape body, RayCaster world);

  Scene scene_;
  BodyShape body_;
  RayCaster world_;
  Nanoseconds now_{0};
};

}  // namespace swiftlet::sim
