// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/counter_random.hpp"

namespace swiftlet::sim {

/// A steady wind with gusts; none by default.
struct WindOptions {
  Eigen::Vector3d mean_mps = Eigen::Vector3d::Zero();  ///< where it blows to [world]
  double gust_mps = 0.0;     ///< standard deviation along each level axis; half of that upright
  double gust_time_s = 1.5;  ///< how long a gust lasts
  double drag_per_s = 0.3;   ///< acceleration of the vehicle by m/s of air that passes it

  [[nodiscard]] bool blows() const { return gust_mps > 0.0 || !mean_mps.isZero(); }
};

/// Air that moves: the mean, and gusts that come and go as a Gauss-Markov process does (the Dryden
/// model's first order). Repeatable: same seed and steps, same wind.
class Wind {
 public:
  Wind(const WindOptions& options, std::uint64_t seed) : options_(options), random_(seed, 0x514D) {}

  void advance(double dt_s);
  [[nodiscard]] Eigen::Vector3d velocity_mps() const;
  /// Acceleration [m/s^2] of a vehicle that moves so; 0 if there is no wind, drag or not.
  [[nodiscard]] Eigen::Vector3d push_mps2(const Eigen::Vector3d& vehicle_mps) const;

 private:
  WindOptions options_;
  CounterRandom random_;
  std::uint64_t draws_ = 0;
  Eigen::Vector3d gust_mps_ = Eigen::Vector3d::Zero();
};

}  // namespace swiftlet::sim
