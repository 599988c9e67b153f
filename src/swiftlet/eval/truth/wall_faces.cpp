// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/wall_faces.hpp"

namespace swiftlet::eval {

std::vector<WallFace> wall_faces(const std::vector<sim::Object>& objects, double least_m) {
  constexpr double kUpright = 0.9999;
  std::vector<WallFace> faces;
  for (const sim::Object& object : objects) {
    const auto* box = std::get_if<sim::Box>(&object.shape);
    if (box == nullptr) continue;
    const Eigen::Matrix3d R = box->R_world_box.toRotationMatrix();
    if (R(2, 2) < kUpright || box->size_m.z() < least_m) continue;
    for (const int axis : {0, 1}) {
      const double length_m = box->size_m[1 - axis];
      if (length_m < least_m) continue;
      for (const double sign : {1.0, -1.0}) {
        const Eigen::Vector3d normal = sign * R.col(axis);
        // normal x up lies along the face, so that up x along = normal
        const Eigen::Vector3d along = normal.cross(Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d corner = box->centre_m + 0.5 * box->size_m[axis] * normal -
                                       0.5 * length_m * along -
                                       Eigen::Vector3d(0, 0, 0.5 * box->size_m.z());
        faces.push_back({corner, along, normal, length_m, box->size_m.z()});
      }
    }
  }
  return faces;
}

}  // namespace swiftlet::eval
