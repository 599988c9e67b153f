// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/stereo_camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet::sim {
namespace {

constexpr double kFocal_px = 415.2;  // method 3: 848 px, 91.2 deg
constexpr double kFocalBaseline = kFocal_px * 0.05;

/// Full width, so that the focal length is the D435's; few rows, so that the test is quick.
StereoOptions d435_strip(int rows) {
  StereoOptions options;
  options.height = rows;
  return options;
}

Scene scene_of(std::vector<Object> objects, double texture = 1.0) {
  Scene scene;
  scene.materials = {{"stuff", texture}};
  scene.objects = std::move(objects);
  return scene;
}

Object wall_at(double x_m) { return {"wall", Plane{{x_m, 0, 0}, {-1, 0, 0}}}; }

DepthImage capture(const Scene& scene, const StereoOptions& options, std::uint64_t seed = 1,
                   std::uint64_t frame = 0, unsigned threads = 2) {
  const auto world = RayCaster::create(scene).value();
  auto camera = StereoCamera::create(options, seed, threads).value();
  return camera.capture(world, Flight().camera_at(Nanoseconds(0)), frame);
}

std::vector<std::uint16_t> bytes(const DepthImage& depth) {
  return {depth.raw.pixels().begin(), depth.raw.pixels().end()};
}

double valid_share(const DepthImage& depth) {
  const auto pixels = depth.raw.pixels();
  return 1.0 -
         static_cast<double>(std::ranges::count(pixels, 0)) / static_cast<double>(pixels.size());
}

class NoiseOnAWall : public ::testing::TestWithParam<double> {};

TEST_P(NoiseOnAWall, follows_the_square_law_of_stereo) {
  const double z_m = GetParam();
  const StereoOptions options = d435_strip(60);
  const DepthImage depth = capture(scene_of({wall_at(z_m)}), options);
  const auto pixels = depth.raw.pixels();
  const auto n = static_cast<double>(pixels.size());
  ASSERT_EQ(std::ranges::count(pixels, 0), 0);
  double sum = 0.0, sum_of_squares = 0.0;
  for (std::uint16_t mm : pixels) sum += mm * 1e-3;
  for (std::uint16_t mm : pixels) sum_of_squares += std::pow(mm * 1e-3 - sum / n, 2);

  // Quantisation adds the variance of a uniform step, in disparity and in millimetres.
  const double s_px =
      std::hypot(options.disparity_noise_px, options.disparity_step_px / std::sqrt(12));
  const double sigma_m = std::hypot(z_m * z_m * s_px / kFocalBaseline, 1e-3 / std::sqrt(12));
  // 50 880 samples know sigma to 0.3 %; 1 / d is not linear: 4 (s / d)^2 = 0.4 % at 8 m.
  EXPECT_NEAR(std::sqrt(sum_of_squares / n), sigma_m, 0.015 * sigma_m);
  // E[1 / (d + e)] = (1 + (s / d)^2) / d; the mean is known to sigma / sqrt(n). At 1 m the few
  // steps of disparity lie 1.5 mm apart, and each is rounded by up to 0.5 mm.
  const double bias_m = z_m * std::pow(s_px * z_m / kFocalBaseline, 2);
  EXPECT_NEAR(sum / n, z_m + bias_m, 5.0 * sigma_m / std::sqrt(n) + 5e-4);
}
INSTANTIATE_TEST_SUITE_P(Distances, NoiseOnAWall, ::testing::Values(1.0, 4.0, 8.0));

TEST(StereoCamera, casts_its_shadow_on_the_left_as_wide_as_the_change_of_disparity) {
  for (const auto& [near_m, far_m] : {std::pair{1.0, 4.0}, {2.0, 3.5}, {0.5, 8.0}}) {
    StereoOptions options = d435_strip(3);
    options.mixed_pixel_chance = 0.0;
    const DepthImage depth = capture(
        scene_of({wall_at(far_m), {"box", Box{{near_m + 0.005, 0, 0}, {0.01, 0.3 * near_m, 1}}}}),
        options);
    const auto row = depth.raw.row(1);
    const auto is_near = [&](std::uint16_t mm) { return mm > 0 && mm < 500 * (near_m + far_m); };
    const auto first = std::ranges::find_if(row, is_near);
    const auto lost = std::ranges::count(row.begin(), first, 0);
    EXPECT_NEAR(static_cast<double>(lost), kFocalBaseline * (1 / near_m - 1 / far_m), 1.5);
    EXPECT_TRUE(std::all_of(first - lost, first, [](auto mm) { return mm == 0; })) << "one strip";
    EXPECT_EQ(std::count(first, row.end(), 0), 0) << "nothing is lost on the right";
  }
}

TEST(StereoCamera, without_noise_measures_plane_and_cylinder_exactly) {
  test::Random random;
  StereoOptions options = d435_strip(21);
  options.is_ideal = true;
  const double r = random.real(0.2, 0.6), x = random.real(2, 4), y = random.real(-1, 1);
  const Eigen::Vector3d normal(-1, random.real(-0.5, 0.5), random.real(-0.3, 0.3));
  const Scene scene = scene_of(
      {{"wall", Plane{{6, 0, 0}, normal}}, {"column", Cylinder{{x, y, -20}, {x, y, 20}, 2 * r}}});
  const DepthImage depth = capture(scene, options);
  const auto k = StereoCamera::create(options, 1)->intrinsics();
  int on_column = 0;
  for (int v = 0; v < options.height; ++v) {
    for (int u = 0; u < options.width; ++u) {
      // The ray in world axes, with x (the depth) = 1.
      const Eigen::Vector3d ray(1.0, -(u - k.cx()) / k.fx(), -(v - k.cy()) / k.fy());
      const double on_plane = normal.x() * 6.0 / normal.dot(ray);
      const Eigen::Vector2d axis(x, y), level = ray.head<2>();
      const double b = axis.dot(level), a = level.squaredNorm();
      const double root2 = b * b - a * (axis.squaredNorm() - r * r);
      const double cos_incidence = std::sqrt(std::abs(root2) / a) / r;
      if (cos_incidence < 0.2) continue;  // the prism's silhouette differs
      const double z = root2 > 0 ? std::min(on_plane, (b - std::sqrt(root2)) / a) : on_plane;
      if (root2 > 0) ++on_column;
      // Half a millimetre of rounding; of the prism, 0.1 mm / cos; floats.
      EXPECT_NEAR(depth.depth_m(u, v), z, 0.0005 + kMaxSagitta_m / 2 / cos_incidence + 1e-5)
          << u << ' ' << v << ", " << random.repeat();
    }
  }
  EXPECT_GT(on_column, 100);
}

TEST(StereoCamera, with_a_barrel_of_a_tenth_sees_the_edges_of_a_wall_at_1_4_m_a_tenth_too_far) {
  StereoOptions options = d435_strip(241);
  options.is_ideal = true;
  options.barrel = 0.1;
  const DepthImage depth = capture(scene_of({wall_at(1.4)}), options);
  EXPECT_NEAR(depth.depth_m(options.width / 2, 120), 1.4, 1e-3);
  EXPECT_NEAR(depth.depth_m(0, 120), 1.1 * 1.4, 1e-3);
  EXPECT_NEAR(depth.depth_m(options.width - 1, 120), 1.1 * 1.4, 1e-3);
  EXPECT_GT(depth.depth_m(0, 0), 1.1 * 1.4) << "the corners are farther from the axis";
  // An error of disparity: twice the distance, about twice the share.
  const DepthImage far = capture(scene_of({wall_at(2.8)}), options);
  EXPECT_NEAR(far.depth_m(0, 120) / 2.8, 1.0 / (1.0 - 2.0 * (1.0 - 1.0 / 1.1)), 2e-3);
}

TEST(StereoCamera, gives_the_same_bytes_for_the_same_seed_on_any_number_of_threads) {
  const Scene scene = scene_of({wall_at(3), {"box", Box{{2, 0, 0}, {0.2, 0.5, 0.1}}}}, 0.4);
  const StereoOptions options = d435_strip(33);
  const auto reference = bytes(capture(scene, options, 5, 9, 1));
  EXPECT_EQ(bytes(capture(scene, options, 5, 9, 2)), reference);
  EXPECT_EQ(bytes(capture(scene, options, 5, 9, 3)), reference);
  EXPECT_NE(bytes(capture(scene, options, 6, 9, 2)), reference) << "another seed";
  EXPECT_NE(bytes(capture(scene, options, 5, 10, 2)), reference) << "another frame";
}

TEST(StereoCamera, loses_blank_surfaces_as_often_as_it_says) {
  const StereoOptions options = d435_strip(96);
  EXPECT_EQ(valid_share(capture(scene_of({wall_at(2)}, 0.5), options)), 1.0);
  EXPECT_EQ(valid_share(capture(scene_of({wall_at(2)}, 0.0), options)), 0.0);
  // Texture 0.25 fails with chance (1 - 0.25 / 0.5)^2 = 1/4; 3/4 of the pixels go with one of 1272
  // patches, which leaves sqrt(3/16 / 1272) * 3/4 = 0.9 %.
  EXPECT_NEAR(valid_share(capture(scene_of({wall_at(2)}, 0.25), options)), 0.75, 0.045);
}

TEST(StereoCamera, loses_surfaces_that_it_grazes) {
  // A floor 5 cm below the camera: beyond 1 m it is seen under less than 3 degrees.
  StereoOptions options = d435_strip(480);
  options.width = 106;
  options.hfov_rad = 2 * std::atan(53 / kFocal_px);
  const DepthImage depth = capture(scene_of({{"floor", Plane{{0, 0, -0.05}, {0, 0, 1}}}}), options);
  for (int u = 0; u < 106; ++u) EXPECT_EQ(depth.raw.at(u, 241), 0);
  for (int u = 20; u < 106; ++u) EXPECT_NE(depth.raw.at(u, 330), 0);
}

TEST(StereoCamera, reports_nothing_outside_its_range) {
  EXPECT_EQ(valid_share(capture(scene_of({wall_at(0.15)}), d435_strip(3))), 0.0);
  EXPECT_EQ(valid_share(capture(scene_of({wall_at(25.0)}), d435_strip(3))), 0.0);
  EXPECT_EQ(valid_share(capture(scene_of({wall_at(0.3)}), d435_strip(3))), 1.0);
}

TEST(StereoCamera, mixes_depths_at_edges_and_only_there) {
  StereoOptions options = d435_strip(61);
  options.disparity_noise_px = 0.0;
  const Scene scene = scene_of({wall_at(4), {"box", Box{{1.05, 0, 0}, {0.1, 0.4, 9}}}});
  const auto between = [&](double chance) {
    options.mixed_pixel_chance = chance;
    const DepthImage depth = capture(scene, options);
    return std::ranges::count_if(depth.raw.pixels(),
                                 [](auto mm) { return mm > 1100 && mm < 3800; });
  };
  EXPECT_EQ(between(0.0), 0);
  // At most two pixels at each of the two edges of each row.
  EXPECT_GT(between(1.0), 61);
  EXPECT_LE(between(1.0), 4 * 61);
}

}  // namespace
}  // namespace swiftlet::sim
