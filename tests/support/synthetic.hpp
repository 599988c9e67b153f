// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cmath>
#include <cstdint>

#include "support/seeds.hpp"
#include "swiftlet/frame/frame.hpp"

namespace swiftlet::test {

/// A small camera for core tests: 40 x 30 pixels unless told otherwise, about 90 degrees wide.
inline PinholeIntrinsics small_camera(int width = 40, int height = 30) {
  return *PinholeIntrinsics::create(width, height, 0.5 * width, 0.5 * width, 0.5 * (width - 1),
                                    0.5 * (height - 1));
}

/// A frame of a wall that fills the view, `depth_m` ahead; from the origin along +x unless told
/// otherwise.
inline Frame wall_frame(const PinholeIntrinsics& camera, double depth_m,
                        const Transform<World, Camera>& T_world_camera = Transform<World, Body>{} *
                                                                         forward_looking_camera()) {
  const auto raw = static_cast<std::uint16_t>(std::lround(depth_m * 1000.0));
  return {Stamp{},
          {Image<std::uint16_t>(camera.width(), camera.height(), raw), 0.001F},
          camera,
          T_world_camera};
}

/// A frame of random relief with holes, from a random place and attitude within `spread_m` of the
/// origin.
inline Frame random_frame(Random& random, const PinholeIntrinsics& camera, double spread_m = 0.5) {
  const Eigen::Quaterniond rotation = random.rotation();
  const auto T_world_camera =
      Transform<World, Camera>::trusted(rotation, random.vector(-spread_m, spread_m));
  Frame frame = wall_frame(camera, 1.0, T_world_camera);
  const double base = random.real(0.5, 3.0);
  for (std::uint16_t& d : frame.depth.raw.pixels()) {
    d = random.chance(0.2) ? std::uint16_t{0}
                           : static_cast<std::uint16_t>(1000.0 * (base + random.real(0.0, 0.6)));
  }
  return frame;
}

}  // namespace swiftlet::test
