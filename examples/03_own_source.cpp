// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: my camera and my poses come from somewhere else; how do I feed them in?
// Run: example_03_own_source

#include <chrono>
#include <cstdio>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/source/rig/rig.hpp"

using namespace std::chrono_literals;

int main() {
  const auto camera = swiftlet::PinholeIntrinsics::create(160, 120, 80.0, 80.0, 79.5, 59.5);
  swiftlet::MapperConfig config;
  config.depth.downsample = 1;  // a small image: keep every pixel
  auto mapper = swiftlet::Mapper::create(config);
  if (!camera || !mapper) return 1;

  // The rig joins depth images with poses in time; the camera looks forward, 10 cm ahead of the
  // body's origin.
  swiftlet::Rig::Options options;
  options.cameras[0].T_body_camera = swiftlet::Transform<swiftlet::Body, swiftlet::Body>::trusted(
                                         Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0}) *
                                     swiftlet::forward_looking_camera();
  swiftlet::Rig rig(options);

  // Yours: poses at 200 Hz, depth at 30 Hz, in whatever order they arrive. Here: 1 m/s towards a
  // wall at x = 5 m.
  for (int ms = 0; ms < 2000; ms += 5) {
    const swiftlet::Stamp now{std::chrono::nanoseconds(ms * 1ms).count()};
    const double x_m = 0.001 * ms;
    rig.push(swiftlet::PoseSample{now, Eigen::Quaterniond::Identity(), {x_m, 0.0, 0.0}});
    if (ms % 35 == 0) {
      const auto depth_mm = static_cast<std::uint16_t>(1000.0 * (5.0 - x_m - 0.1));
      rig.push(swiftlet::DepthFrame{
          now, {swiftlet::Image<std::uint16_t>(160, 120, depth_mm), 0.001F}, *camera});
    }
    while (const auto frame = rig.pop()) mapper->integrate(*frame);
  }

  const auto wall = swiftlet::voxel_containing({5.1, 0.1, 0.1}, mapper->map().voxel_m());
  std::printf("%llu frames, the wall's voxel is at %d of 255\n",
              static_cast<unsigned long long>(mapper->frame_count()), mapper->map().log_odds(wall));
  return mapper->map().log_odds(wall) > 180 ? 0 : 1;
}
