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

/// Random numbers of a law test. The seed stands in the test's XML and in every failure;
/// SWIFTLET_TEST_SEED repeats it.
class Random {
 public:
  explicit Random(std::uint64_t seed = seed_from_environment()) : engine_(seed), seed_(seed) {
    ::testing::Test::RecordProperty("seed", std::to_string(seed));
  }

  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  [[nodiscard]] std::string repeat() const {
    return "repeat with SWIFTLET_TEST_SEED=" + std::to_string(seed_);
  }

  double real(double low, double high) {
    return std::uniform_real_distribution(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution(low, high)(engine_); }
  bool chance(double p) { return std::bernoulli_distribution(p)(engine_); }
  double gaussian(double sigma) { return std::normal_distribution(0.0, sigma)(engine_); }
  Eigen::Vector3d vector(double low, double high) {
    return {real(low, high), real(low, high), real(low, high)};
  }
  Eigen::Quaterniond rotation() {
    const Eigen::Vector4d q(gaussian(1), gaussian(1), gaussian(1), gaussian(1));
    return Eigen::Quaterniond(q.normalized());
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  static std::uint64_t seed_from_environment() {
    const char* text = std::getenv("SWIFTLET_TEST_SEED");
    return text == nullptr ? 20240607U : std::strtoull(text, nullptr, 10);
  }
  std::mt19937_64 engine_;
  std::uint64_t seed_;
};

}  // namespace swiftlet::test
