// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>

#include "swiftlet/query/sweep/body_shape.hpp"

namespace swiftlet {

/// A part of a body while it moves straight ahead without turning: all points centre + sum l_i
/// half_i with -1 <= l_i <= 1, and a ball of `radius` around each. Half edge 0 is the move itself.
/// In voxels of the world grid, as GridRay: a voxel's edge is 1.
struct MovingPart {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 4> half{};
  std::array<double, 4> square{};  // |half|^2; 0: none
  double radius = 0.0;

  /// Half the size of the box around it, radius included.
  [[nodiscard]] Eigen::Array3d half_extent() const {
    return half[0].array().abs() + half[1].array().abs() + half[2].array().abs() +
           half[3].array().abs() + radius;
  }
};

/// What is left undecided for rounding: beyond it, a gap is one. [voxels]
inline constexpr double kSlack_voxels = 1e-6;

/// `R` and `middle` place the body half way along the move, `half_move` leads on to its end.
[[nodiscard]] MovingPart make_moving_part(const BodyShape::Part& part, const Eigen::Matrix3d& R,
                                          const Eigen::Vector3d& middle,
                                          const Eigen::Vector3d& half_move, double voxels_per_m,
                                          double extra_radius);

/// A cube of the grid: a voxel (half edge 0.5) or a block (4). [voxels]
struct GridCube {
  Eigen::Array3d centre;
  double half_edge;
};

/// How far the edges of a part (without its radius) and a cube are apart, narrowed down from both
/// sides.
///
/// The upper bound is the distance of two points, one of each. The lower one is the width of a slab
/// that lies between both, across the line from one point to the other: a proof, however far the
/// search for the nearest points has come. A sweep calls space clear by such a proof alone, so it
/// is conservative by construction. The points slide, one half edge at a time, each to where it is
/// nearest; Newton's step finds that within a few steps, since the squared distance to a cube along
/// a line is convex and made of parabolas.
class GapSearch {
 public:
  GapSearch(const MovingPart& part, const GridCube& cube)
      : part_(part),
        start_(part.centre.array() - cube.centre),
        half_edge_(cube.half_edge),
        between_(start_) {
    settle();
  }

  /// One round over the half edges.
  void improve();
  [[nodiscard]] double at_least() const;
  [[nodiscard]] double at_most() const { return std::sqrt(square_); }
  /// Where along the move the nearest point is: -1 at its begin, 1 at its end.
  [[nodiscard]] double along() const { return share_[0]; }

 private:
  void settle() {
    outside_ = between_ - between_.max(-half_edge_).min(half_edge_);
    square_ = outside_.square().sum();
  }
  void slide(std::size_t i, double to);

  const MovingPart& part_;
  Eigen::Array3d start_;  // from the cube's centre to the part's
  double half_edge_;
  std::array<double, 4> share_{};  // the point of the part, by its half edges
  Eigen::Array3d between_;         // from the cube's centre to that point
  Eigen::Array3d outside_;         // from the nearest point of the cube to it
  double square_ = 0.0;            // |outside_|^2
};

/// Whether part and cube may touch. False is certain; true may be wrong by a small part of a voxel.
[[nodiscard]] bool may_touch(const MovingPart& part, const GridCube& cube);

/// A lower bound of the gap between part (with its radius) and cube, to a hundredth of a voxel;
/// what is `enough` or more is not narrowed down.
struct Gap {
  double at_least;
  double along;  ///< as GapSearch::along()
};
[[nodiscard]] Gap gap_between(const MovingPart& part, const GridCube& cube, double enough);

}  // namespace swiftlet
