// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/face_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::Random;

constexpr float kFaceVoxel_m = 0.1F;

/// Random axes of the world in camera axes.
std::array<Float3, 3> random_axes(Random& random) {
  const Eigen::Matrix3d R = random.rotation().toRotationMatrix();
  std::array<Float3, 3> axes;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      axes[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = static_cast<float>(R(k, i));
  }
  return axes;
}

Float3 random_place(Random& random) {
  Float3 p;
  for (float& v : p) v = static_cast<float>(random.real(-4.0, 4.0));
  return p;
}

TEST(FaceSamples, are_as_many_as_asked_for_and_lie_on_the_faces) {
  test::for_each_seed(500, [](Random& random) {
    const std::array<Float3, 3> axes = random_axes(random);
    const int count = random.integer(1, FaceSamples::kMost);
    FaceSamples samples;
    samples.spread(count, random_place(random), kFaceVoxel_m, axes,
                   static_cast<std::uint64_t>(random.integer(0, 100000)));
    std::size_t all = 0;
    for (std::size_t face = 0; face < 3; ++face) {
      const auto on_face = samples.on_face(face);
      EXPECT_GE(on_face.size(), 1U) << "a face that is seen is looked at";
      all += on_face.size();
      for (const FaceSample& s : on_face) {
        EXPECT_LE(std::abs(s.along_j), 0.5F * kFaceVoxel_m);
        EXPECT_LE(std::abs(s.along_k), 0.5F * kFaceVoxel_m);
        for (std::size_t k = 0; k < 3; ++k) {
          const float to =
              s.along_j * axes[(face + 1) % 3][k] + s.along_k * axes[(face + 2) % 3][k];
          EXPECT_NEAR(s.to[k], to, 1e-7F);
        }
      }
    }
    // Each face rounds to the nearest number of its own.
    EXPECT_GE(all + 2, static_cast<std::size_t>(count));
    EXPECT_LE(all, static_cast<std::size_t>(count) + 3);
  });
}

// The share of a face in the image is that of its distance along its axis.
TEST(FaceSamples, are_shared_out_by_how_much_of_the_image_a_face_takes) {
  FaceSamples samples;
  Random random;
  samples.spread(48, {3.05F, 1.55F, 0.55F}, kFaceVoxel_m, random_axes(random), 0);
  EXPECT_NEAR(static_cast<double>(samples.on_face(0).size()), 48.0 * 3.0 / 5.0, 0.51);
  EXPECT_NEAR(static_cast<double>(samples.on_face(1).size()), 48.0 * 1.5 / 5.0, 0.51);
  EXPECT_NEAR(static_cast<double>(samples.on_face(2).size()), 48.0 * 0.5 / 5.0, 0.51);
}

/// The largest part of a unit square's strips [0, x) that the share of points in them is off by.
double unevenness(std::vector<float> places) {
  std::ranges::sort(places);
  double worst = 0.0;
  const auto n = static_cast<double>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = double{places[i]} / double{kFaceVoxel_m} + 0.5;
    worst = std::max({worst, std::abs(x - static_cast<double>(i) / n),
                      std::abs(x - static_cast<double>(i + 1) / n)});
  }
  return worst;
}

// A lattice of n points leaves no strip emptier than a random draw would: discrepancy 2 / n, where
// that of random points is about 1 / sqrt(n). The first few are spread, too.
TEST(FaceSamples, are_spread_evenly_and_so_are_the_first_few) {
  test::for_each_seed(200, [](Random& random) {
    FaceSamples samples;
    samples.spread(FaceSamples::kMost, {3.05F, 0.01F, 0.02F}, kFaceVoxel_m, random_axes(random),
                   static_cast<std::uint64_t>(random.integer(0, 5000)));
    const auto on_face = samples.on_face(0);
    ASSERT_GT(on_face.size(), 40U);
    for (const std::size_t first : {on_face.size(), std::size_t{8}}) {
      std::vector<float> j, k;
      for (const FaceSample& s : on_face.first(first)) {
        j.push_back(s.along_j);
        k.push_back(s.along_k);
      }
      const double most = first == on_face.size() ? 0.1 : 0.4;
      EXPECT_LE(unevenness(j), most) << first;
      EXPECT_LE(unevenness(k), most) << first;
    }
  });
}

TEST(FaceSamples, fall_elsewhere_in_the_next_frame) {
  Random random;
  const std::array<Float3, 3> axes = random_axes(random);
  FaceSamples one, next;
  one.spread(24, {2.0F, 1.0F, 1.0F}, kFaceVoxel_m, axes, 7);
  next.spread(24, {2.0F, 1.0F, 1.0F}, kFaceVoxel_m, axes, 8);
  for (std::size_t face = 0; face < 3; ++face) {
    ASSERT_EQ(one.on_face(face).size(), next.on_face(face).size());
    for (std::size_t i = 0; i < one.on_face(face).size(); ++i)
      EXPECT_NE(one.on_face(face)[i].along_j, next.on_face(face)[i].along_j);
  }
}

}  // namespace
}  // namespace swiftlet
