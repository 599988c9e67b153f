// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/vehicle/wind.hpp"

#include <cmath>

namespace swiftlet::sim {

void Wind::advance(double dt_s) {
  if (options_.gust_mps <= 0.0) return;
  const double kept = std::exp(-dt_s / options_.gust_time_s);
  const double fresh = options_.gust_mps * std::sqrt(1.0 - kept * kept);
  for (double& along : gust_mps_) along = kept * along + fresh * random_.gaussian(draws_++);
}

Eigen::Vector3d Wind::velocity_mps() const {
  constexpr double kUprightShare = 0.5;  // the ground lets air move less up and down
  return options_.mean_mps +
         Eigen::Vector3d(gust_mps_.x(), gust_mps_.y(), kUprightShare * gust_mps_.z());
}

Eigen::Vector3d Wind::push_mps2(const Eigen::Vector3d& vehicle_mps) const {
  if (!options_.blows()) return Eigen::Vector3d::Zero();
  return options_.drag_per_s * (velocity_mps() - vehicle_mps);
}

}  // namespace swiftlet::sim
