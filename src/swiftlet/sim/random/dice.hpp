// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "swiftlet/sim/counter_random.hpp"
#include "swiftlet/sim/flight.hpp"

namespace swiftlet::sim {

/// Random numbers of a scene, the same with every standard library. Compilers differ in the order
/// in which they evaluate arguments and operands: throw once in an expression, or between braces.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t attempt) : random_(seed, 0x5CE7E + attempt) {}

  /// Uniform in [low, high).
  double real(double low, double high) {
    const double share = static_cast<double>(random_.bits(count_++) >> 11) * 0x1p-53;
    return low + share * (high - low);
  }
  /// Uniform in [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(std::floor(real(0.0, high - low + 1.0)));
  }
  bool chance(double p) { return real(0.0, 1.0) < p; }
  /// A whole number whose mean is `mean`.
  int about(double mean) { return static_cast<int>(std::floor(mean + real(0.0, 1.0))); }
  double angle() { return real(0.0, 2.0 * std::numbers::pi); }

  /// Somewhere in a box.
  Eigen::Vector3d point(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = real(low[axis], high[axis]);
    return p;
  }
  /// Any heading; of unit length, rising by an angle within limits.
  Eigen::Vector3d direction(double rise_low_rad, double rise_high_rad) {
    const double turn = angle();
    const double rise = real(rise_low_rad, rise_high_rad);
    return {std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise)};
  }
  /// Any heading, pitched and rolled by at most an angle.
  Eigen::Quaterniond attitude(double most_rad) {
    const double yaw = angle();
    const double pitch = real(-most_rad, most_rad);
    return rotation_from_ypr(yaw, pitch, real(-most_rad, most_rad));
  }

 private:
  CounterRandom random_;
  std::uint64_t count_ = 0;
};

}  // namespace swiftlet::sim
