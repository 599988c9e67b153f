// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/world_axes.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace swiftlet {
namespace {

constexpr std::array<std::string_view, 6> kUpAxes{"+z", "-y", "+y", "-z", "+x", "-x"};

/// Rows: our x, y and z in native axes; proper rotations all.
Transform<World, NativeWorld> of_rows(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                                      const Eigen::Vector3d& z) {
  Eigen::Matrix3d R;
  R << x.transpose(), y.transpose(), z.transpose();
  return Transform<World, NativeWorld>::trusted(Eigen::Quaterniond(R), Eigen::Vector3d::Zero());
}

}  // namespace

std::string_view up_axis(WorldAxes axes) { return kUpAxes[static_cast<std::size_t>(axes)]; }

std::optional<WorldAxes> axes_with_up(std::string_view axis) {
  const std::string word = axis.size() == 1 ? "+" + std::string(axis) : std::string(axis);
  const auto* const found = std::ranges::find(kUpAxes, word);
  if (found == kUpAxes.end()) return std::nullopt;
  return static_cast<WorldAxes>(found - kUpAxes.begin());
}

Transform<World, NativeWorld> world_from(WorldAxes axes) {
  switch (axes) {
    case WorldAxes::kOptical:
      // x = z_native, y = -x_native, z = -y_native: our world is to the native one what a body is
      // to its camera.
      return Transform<World, NativeWorld>::trusted(forward_looking_camera().rotation(),
                                                    Eigen::Vector3d::Zero());
    case WorldAxes::kYUp:
      return of_rows({0, 0, -1}, {-1, 0, 0}, {0, 1, 0});
    case WorldAxes::kZDown:
      return of_rows({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
    case WorldAxes::kXUp:
      return of_rows({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
    case WorldAxes::kXDown:
      return of_rows({0, -1, 0}, {0, 0, 1}, {-1, 0, 0});
    case WorldAxes::kZUp:
      break;
  }
  return {};
}

}  // namespace swiftlet
