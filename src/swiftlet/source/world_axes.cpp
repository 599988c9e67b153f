// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/world_axes.hpp"

namespace swiftlet {

std::string_view up_axis(WorldAxes axes) { return axes == WorldAxes::kZUp ? "+z" : "-y"; }

Transform<World, NativeWorld> world_from(WorldAxes axes) {
  if (axes == WorldAxes::kZUp) return {};
  // x = z_native, y = -x_native, z = -y_native: our world is to the native one what a body is to
  // its camera.
  return Transform<World, NativeWorld>::trusted(forward_looking_camera().rotation(),
                                                Eigen::Vector3d::Zero());
}

}  // namespace swiftlet
