// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The same frames give the same map bits on every kind of machine: these were written on x86-64 and
// are compared on aarch64, too (tests/aarch64). A change of the method may change them; then all
// machines must agree on the new ones.

#include "support/map_bits.hpp"

#include <gtest/gtest.h>

#include "support/synthetic.hpp"

namespace swiftlet {
namespace {

constexpr const char* kInverse = "inverse_sensor_model";

struct Case {
  const char* name;
  const char* integrator;
  const char* ray_method;
  int downsample;
  const char* model;
  std::uint64_t hash;
};

class MapBitsOf : public ::testing::TestWithParam<Case> {};

TEST_P(MapBitsOf, are_those_of_every_machine) {
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.integrate.integrator = GetParam().integrator;
  config.integrate.ray_method = GetParam().ray_method;
  config.depth.downsample = GetParam().downsample;
  config.integrate.model = GetParam().model;
  auto mapper = Mapper::create(config);
  ASSERT_TRUE(mapper);
  test::Random random(11);
  for (int i = 0; i < 8; ++i)
    mapper->integrate(test::random_frame(random, test::small_camera(163, 121), 2.0));
  const test::MapBits bits = test::bits_of(*mapper);
  EXPECT_GT(bits.known_voxels, 1000U);
  EXPECT_EQ(bits.hash, GetParam().hash) << bits;
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, MapBitsOf,
    ::testing::Values(
        Case{"every_pixel", "projective", "voxel_traversal", 1, kInverse, 0xe227b995d95ed055U},
        Case{"nearest_of_4_x_4", "projective", "voxel_traversal", 4, kInverse, 0xb9b711321d27e3f3U},
        Case{"voxel_traversal", "rays", "voxel_traversal", 1, kInverse, 0x2fac9742b058cfb2U},
        Case{"line_drawing", "rays", "line_drawing", 1, kInverse, 0xc99587e92dccb4dbU},
        Case{"thin_obstacle_preserving", "projective", "voxel_traversal", 1,
             "thin_obstacle_preserving", 0xdc6603ef0c598542U},
        Case{"precision_weighted", "projective", "voxel_traversal", 1, "precision_weighted",
             0xb6ed84f49341dcefU},
        Case{"precision_weighted_rays", "rays", "voxel_traversal", 1, "precision_weighted",
             0xcbc81c93719d509cU}),
    [](const auto& test) { return std::string(test.param.name); });

/// With what comes before and after the integrator: the depths of a bent camera straightened, and
/// belief let go of where nothing is seen.
TEST(MapBits, are_those_of_every_machine_with_distortion_and_decay) {
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.depth.distortion = {0.03, 0.05, 0.01, -0.02, 0.01};
  config.integrate.decay_s = 1.0;
  for (const int threads : {1, 2}) {
    config.integrate.threads = threads;
    auto mapper = Mapper::create(config);
    ASSERT_TRUE(mapper);
    test::Random random(12);
    std::size_t decayed = 0;
    for (int i = 0; i < 12; ++i) {
      Frame frame = test::random_frame(random, test::small_camera(163, 121), 2.0);
      frame.stamp = {100'000'000LL * i};
      decayed += mapper->integrate(frame).decayed;
    }
    EXPECT_GT(decayed, 1000U);
    const test::MapBits bits = test::bits_of(*mapper);
    EXPECT_EQ(bits.hash, 0x5079e03efb611705U) << bits;
  }
}

}  // namespace
}  // namespace swiftlet
