// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

struct World {};   ///< x forward, y left, z up at the start pose (ROS REP-103); gravity-aligned
struct Body {};    ///< x forward, y left, z up, fixed to the vehicle
struct Camera {};  ///< x right, y down, z forward along the optical axis

/// Checks that a rotation and a translation are finite and the rotation proper, and cleans the
/// rotation of rounding. Accepts |q| within 1e-3 of 1 (text files carry four digits) and R^T R
/// within 5e-3 of the identity, det > 0. Errors: kCorruptInput with the reason.
[[nodiscard]] Expected<Eigen::Quaterniond> checked_rotation(const Eigen::Quaterniond& q);
/// The same of a rotation matrix.
[[nodiscard]] Expected<Eigen::Quaterniond> checked_rotation(const Eigen::Matrix3d& R);
/// Errors: kCorruptInput if it is not finite.
[[nodiscard]] Status check_translation(const Eigen::Vector3d& t);

/// Rigid transform that maps points of frame From to frame To: p_to = T_to_from * p_from [m].
/// Only neighbours that match compose; `T_body_camera * T_world_body` does not compile.
template <class To, class From>
class Transform {
 public:
  /// The identity: both frames coincide.
  Transform() = default;

  /// From a rotation and a translation [m]. Errors: kCorruptInput, as checked_rotation() and
  /// check_translation().
  [[nodiscard]] static Expected<Transform> from(const Eigen::Quaterniond& rotation,
                                                const Eigen::Vector3d& translation_m) {
    return checked(rotation, translation_m);
  }
  /// From a homogeneous 4x4 matrix; the last row must be 0 0 0 1. Recordings mark a lost pose by
  /// a matrix full of -inf or NaN, so that is told first.
  [[nodiscard]] static Expected<Transform> from_matrix(const Eigen::Matrix4d& T) {
    if (!T.allFinite())
      return fail(ErrorCode::kCorruptInput, {}, "the pose matrix is not finite (inf or NaN)");
    if (!(T.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(1e-6)) {
      return fail(ErrorCode::kCorruptInput, {}, "the last row of the pose matrix is not 0 0 0 1");
    }
    return checked(Eigen::Matrix3d(T.topLeftCorner<3, 3>()), T.topRightCorner<3, 1>());
  }

  /// Turns From's axes into To's; of length 1.
  [[nodiscard]] const Eigen::Quaterniond& rotation() const { return rotation_; }
  /// From's origin in To [m].
  [[nodiscard]] const Eigen::Vector3d& translation() const { return translation_m_; }

  /// Maps back.
  [[nodiscard]] Transform<From, To> inverse() const {
    const Eigen::Quaterniond back = rotation_.conjugate();
    return Transform<From, To>::trusted(back, -(back * translation_m_));
  }
  /// A point [m] of From in To.
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& p_from) const {
    return rotation_ * p_from + translation_m_;
  }
  /// Composes neighbours: `T_world_camera = T_world_body * T_body_camera`.
  template <class Next>
  [[nodiscard]] Transform<To, Next> operator*(const Transform<From, Next>& T_from_next) const {
    return Transform<To, Next>::trusted((rotation_ * T_from_next.rotation()).normalized(),
                                        *this * T_from_next.translation());
  }

  /// For rotations that are unit by construction. REQUIRES: |rotation| = 1 to rounding, all values
  /// finite.
  [[nodiscard]] static Transform trusted(const Eigen::Quaterniond& rotation,
                                         const Eigen::Vector3d& translation_m) {
    Transform T;
    T.rotation_ = rotation;
    T.translation_m_ = translation_m;
    return T;
  }

 private:
  template <class Rotation>
  static Expected<Transform> checked(const Rotation& rotation,
                                     const Eigen::Vector3d& translation_m) {
    if (auto finite = check_translation(translation_m); !finite)
      return forward_error(std::move(finite));
    auto unit = checked_rotation(rotation);
    if (!unit) return forward_error(std::move(unit));
    return trusted(*unit, translation_m);
  }

  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_m_ = Eigen::Vector3d::Zero();
};

/// Axes of a forward-looking camera on a REP-103 body: body x = camera z, body y = -camera x, body
/// z = -camera y.
[[nodiscard]] Transform<Body, Camera> forward_looking_camera();

}  // namespace swiftlet
