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
  template <class Integer>
  Integer integer(Integer low, Integer high) {
    return std::uniform_int_distribution<Integer>(low, high)(engine_);
  }
  bool chance(double p) { return std::bernoulli_distribution(p)(engine_); }
  double gaussian(double sigma) { return std::normal_distribution(0.0, sigma)(engine_); }
  Eigen::Vector3d vector(double low, double high) {
    return {real(low, high), real(low, high), real(low, high)};
  }
  Eigen::Quaterniond rotation() {
    Eigen::Vector4d q;  // one by one: compilers differ in the order of arguments
    for (double& part : q) part = gaussian(1);
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

/// Runs a law over `count` seeds; with SWIFTLET_TEST_SEED set, over that one alone.
template <class Law>
void for_each_seed(std::uint64_t count, Law law) {
  const bool is_repeated = std::getenv("SWIFTLET_TEST_SEED") != nullptr;
  for (std::uint64_t seed = 1; seed <= (is_repeated ? 1 : count); ++seed) {
    Random random = is_repeated ? Random() : Random(seed);
    SCOPED_TRACE(random.repeat());
    law(random);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace swiftlet::test
