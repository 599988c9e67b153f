// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/frame_of.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace swiftlet {
namespace {

constexpr double kUnitTolerance = 1e-3;
constexpr double kOrthonormalTolerance = 5e-3;

}  // namespace

Expected<Eigen::Quaterniond> checked_rotation(const Eigen::Quaterniond& q) {
  if (!q.coeffs().allFinite())
    return fail(ErrorCode::kCorruptInput, {}, "the quaternion is not finite");
  if (std::abs(q.norm() - 1.0) > kUnitTolerance) {
    return fail(ErrorCode::kCorruptInput, {}, "the quaternion is not of unit length");
  }
  return q.normalized();
}

Expected<Eigen::Quaterniond> checked_rotation(const Eigen::Matrix3d& R) {
  if (!R.allFinite()) return fail(ErrorCode::kCorruptInput, {}, "the rotation is not finite");
  if (!(R.transpose() * R).isIdentity(kOrthonormalTolerance) || R.determinant() < 0.0) {
    return fail(ErrorCode::kCorruptInput, {}, "the rotation is not orthonormal");
  }
  // The nearest rotation in the Frobenius sense.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return Eigen::Quaterniond(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()))
      .normalized();
}

Status check_translation(const Eigen::Vector3d& t) {
  if (!t.allFinite()) return fail(ErrorCode::kCorruptInput, {}, "the translation is not finite");
  return Done{};
}

Transform<Body, Camera> forward_looking_camera() {
  Eigen::Matrix3d R_body_camera;
  R_body_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Transform<Body, Camera>::trusted(Eigen::Quaterniond(R_body_camera),
                                          Eigen::Vector3d::Zero());
}

}  // namespace swiftlet
