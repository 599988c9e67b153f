// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace swiftlet::test {

using Rng = std::mt19937_64;

/// Runs a law over `count` seeds. A failure prints its seed; SWIFTLET_TEST_SEED=<seed> then runs
/// that one alone.
template <class Law>
void for_each_seed(std::uint64_t count, Law law) {
  const char* only = std::getenv("SWIFTLET_TEST_SEED");
  const std::uint64_t first = only != nullptr ? std::stoull(only) : 1;
  const std::uint64_t last = only != nullptr ? first : count;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE("repeat with SWIFTLET_TEST_SEED=" + std::to_string(seed));
    Rng rng(seed);
    law(rng);
    if (::testing::Test::HasFailure()) return;
  }
}

[[nodiscard]] inline double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
template <class Integer>
[[nodiscard]] Integer uniform_integer(Rng& rng, Integer low, Integer high) {
  return std::uniform_int_distribution<Integer>(low, high)(rng);
}
[[nodiscard]] inline Eigen::Vector3d uniform_vector(Rng& rng, double reach) {
  const double x = uniform(rng, -reach, reach);
  const double y = uniform(rng, -reach, reach);
  return {x, y, uniform(rng, -reach, reach)};
}
/// Uniform over all rotations: four normal numbers, scaled to unit length.
[[nodiscard]] inline Eigen::Quaterniond uniform_rotation(Rng& rng) {
  std::normal_distribution<double> normal;
  const double w = normal(rng), x = normal(rng), y = normal(rng);
  return Eigen::Quaterniond(w, x, y, normal(rng)).normalized();
}

}  // namespace swiftlet::test
