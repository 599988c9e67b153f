// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The projective integrator against ray tracing, on frames with a known difficulty each.

#include "support/agreement.hpp"

#include <gtest/gtest.h>

#include "support/synthetic.hpp"

namespace swiftlet {
namespace {

using test::AgreementCheck;
using test::Random;

AgreementCheck new_check(std::string_view model = "inverse_sensor_model") {
  return {0.1, {9, 9, 9}, Eigen::Vector3d::Zero(), 10.0, 0.05, model};
}

PinholeIntrinsics camera() { return test::small_camera(320, 240); }

Transform<World, Camera> looking(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& p_m) {
  return Transform<World, Camera>::trusted(rotation, p_m);
}

/// Waves of half a metre, a box before them, and missing pixels: single ones and a patch.
Frame relief(Random& random, const Transform<World, Camera>& T_world_camera) {
  Frame frame = test::wall_frame(camera(), 1.0, T_world_camera);
  auto& raw = frame.depth.raw;
  const double base_m = random.real(1.5, 3.0), waves = random.real(0.02, 0.05);
  const int box_u = random.integer(40, 200), box_v = random.integer(40, 150);
  for (int v = 0; v < raw.height(); ++v) {
    for (int u = 0; u < raw.width(); ++u) {
      const bool is_box = std::abs(u - box_u) < 30 && std::abs(v - box_v) < 20;
      const bool is_patch = std::abs(u - 250) < 20 && std::abs(v - 60) < 15;
      const double z_m =
          is_box ? base_m - 0.9 : base_m + 0.25 * (std::sin(waves * u) + std::cos(waves * v));
      const double sigma_m = 0.005 * z_m * z_m;
      const bool is_missing = is_patch || random.chance(0.05);
      raw.at(u, v) =
          is_missing
              ? std::uint16_t{0}
              : static_cast<std::uint16_t>(std::lround(1000.0 * (z_m + random.gaussian(sigma_m))));
    }
  }
  return frame;
}

TEST(Projective, agrees_with_rays_at_any_attitude) {
  Random random;
  AgreementCheck check = new_check();
  for (int i = 0; i < 3; ++i)
    check.add(relief(random, looking(random.rotation(), random.vector(-0.5, 0.5))));
  SCOPED_TRACE(random.repeat());
  test::expect_agreement(check.result());
}

TEST(Projective, agrees_with_rays_when_moving_along_its_axis) {
  Random random;
  AgreementCheck check = new_check();
  const Eigen::Quaterniond rotation = random.rotation();
  for (int i = 0; i < 3; ++i)
    check.add(relief(random, looking(rotation, rotation * Eigen::Vector3d(0, 0, 0.13 * i))));
  SCOPED_TRACE(random.repeat());
  test::expect_agreement(check.result());
}

// On a corner of the grid, and in the middle of a face. The attitude is random: looking along an
// axis of the grid from one of its planes, whole columns of pixels fall to one side of a voxel's
// face, and the number of rays through a voxel is off from its mean by as much as a column.
TEST(Projective, agrees_with_rays_when_the_camera_stands_on_the_grid_s_planes) {
  Random random;
  for (const Eigen::Vector3d& p_m : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0.05, 0.1)}) {
    AgreementCheck check = new_check();
    for (int i = 0; i < 3; ++i) check.add(relief(random, looking(random.rotation(), p_m)));
    SCOPED_TRACE(random.repeat());
    test::expect_agreement(check.result());
  }
}

TEST(Projective, agrees_with_rays_at_the_edge_of_a_sloping_wall) {
  Random random;
  AgreementCheck check = new_check();
  Frame frame = test::wall_frame(camera(), 2.0, looking(random.rotation(), {0.01, 0.02, 0.03}));
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u)
      frame.depth.raw.at(u, v) = static_cast<std::uint16_t>(1200 + 6 * u);
  }
  check.add(frame);
  SCOPED_TRACE(random.repeat());
  test::expect_agreement(check.result());
}

// A frame and its mirror image, from mirrored places: voxels mirror too. Their samples do not, so a
// single voxel may differ; all together lean to neither side.
TEST(Projective, sees_a_mirrored_frame_mirrored) {
  Random random;
  const auto forward = Transform<World, Body>{} * forward_looking_camera();
  const Frame frame = relief(random, looking(forward.rotation(), {0.03, 0.02, 0.01}));
  Frame mirrored = frame;
  mirrored.T_world_camera = looking(forward.rotation(), {0.03, -0.02, 0.01});
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) mirrored.depth.raw.at(u, v) = frame.depth.raw.at(319 - u, v);
  }
  AgreementCheck a = new_check(), b = new_check();
  a.add(frame);
  b.add(mirrored);
  const VoxelBox box = voxel_box(a.candidate().window());
  double sum = 0.0, sum_of_sizes = 0.0;
  int voxels = 0;
  for (int z = box.first.z; z <= box.last.z; ++z) {
    for (int y = -35; y < 35; ++y) {
      for (int x = 8; x <= box.last.x; ++x) {
        const int left = a.candidate().log_odds({x, y, z});
        const int right = b.candidate().log_odds({x, -1 - y, z});
        if (left == kUnknownVoxel && right == kUnknownVoxel) continue;
        sum += left - right;
        sum_of_sizes += std::abs(left - right);
        ++voxels;
      }
    }
  }
  ASSERT_GT(voxels, 1000);
  EXPECT_NEAR(sum / voxels, 0.0, 0.5) << random.repeat();
  EXPECT_LE(sum_of_sizes / voxels, 3.0) << random.repeat();
}

}  // namespace
}  // namespace swiftlet
