// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

/// What flies, as a planner sees it: a sphere, a capsule, a box, or a union of them. [m, body]
///
/// The origin of the body frame is the point that follows a path and about which the body turns.
class BodyShape {
 public:
  /// All points centre + a u + b v + c w with -1 <= a, b, c <= 1 over the edges, and a ball of
  /// `radius_m` around each. A sphere has no edges, a capsule one, a box three.
  struct Part {
    Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< [body]
    std::array<Eigen::Vector3d, 3>
        half_edges_m{};     ///< of a segment, rectangle or box, from the centre
    int edge_count = 0;     ///< 0 to 3 of them count
    double radius_m = 0.0;  ///< around all that
  };

  /// Sizes must be finite and not negative; 0 is allowed (a point). Errors: kUsage.
  [[nodiscard]] static Expected<BodyShape> sphere(
      double radius_m, const Eigen::Vector3d& centre_m = Eigen::Vector3d::Zero());
  /// All within a radius of a segment [m, body]. Errors: kUsage if a number cannot be used.
  [[nodiscard]] static Expected<BodyShape> capsule(const Eigen::Vector3d& from_m,
                                                   const Eigen::Vector3d& to_m, double radius_m);
  /// `size_m`: whole lengths along the axes of the box, whose middle and attitude the pose tells.
  [[nodiscard]] static Expected<BodyShape> box(const Eigen::Vector3d& size_m,
                                               const Transform<Body, Body>& T_body_box = {});
  /// All of them at once, as one rigid body. Errors: kUsage if there is none.
  [[nodiscard]] static Expected<BodyShape> united(std::span<const BodyShape> shapes);

  /// What it is made of.
  [[nodiscard]] std::span<const Part> parts() const { return parts_; }
  /// The farthest that a point of a part's edges lies from the origin: the lever of its turns.
  [[nodiscard]] double lever_m() const { return lever_m_; }
  /// No point of the body is farther from the origin.
  [[nodiscard]] double reach_m() const { return reach_m_; }

 private:
  BodyShape() = default;
  [[nodiscard]] static Expected<BodyShape> of(const Part& part);
  void add(const Part& part);

  std::vector<Part> parts_;
  double lever_m_ = 0.0;
  double reach_m_ = 0.0;
};

}  // namespace swiftlet
