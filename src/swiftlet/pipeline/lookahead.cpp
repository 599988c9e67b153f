// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/lookahead.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace swiftlet {
namespace {

constexpr double kLongestGap_s = 0.5;  // older steps tell nothing of now

Eigen::Vector3d farthest_ahead(const RollingMap::Options& map) {
  const Eigen::Array3d quarter = 0.25 * map.size_m.array();
  const Eigen::Array3d inside = 0.5 * map.size_m.array() - map.trigger_m.array();
  return quarter.min(inside).max(0.0);
}

/// Seconds from one stamp to a later one; without the overflow of stamps that are far apart.
double seconds_between(Stamp from, Stamp to) {
  return static_cast<double>(static_cast<std::uint64_t>(to.ns) -
                             static_cast<std::uint64_t>(from.ns)) *
         1e-9;
}

}  // namespace

Lookahead::Lookahead(const WindowOptions& window, const RollingMap::Options& map)
    : lookahead_s_(window.lookahead_s), farthest_m_(farthest_ahead(map)) {}

void Lookahead::forget() {
  last_.fill(std::nullopt);
  step_count_ = 0;
}

Eigen::Vector3d Lookahead::velocity_mps() const {
  const std::size_t n = std::min(step_count_, kSteps);
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  if (n < 3) return median;  // of two, one may be a jump
  std::array<double, kSteps> values{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < n; ++i) values[i] = steps_mps_[i][axis];
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(n));
    median[axis] = *middle;
  }
  return median;
}

Eigen::Vector3d Lookahead::middle_for(const Frame& frame) {
  const Eigen::Vector3d& p_world = frame.T_world_camera.translation();
  std::optional<Place>& last = last_[frame.camera];
  const bool is_anew = frame.pose_epoch != pose_epoch_ || (last && frame.stamp < last->stamp) ||
                       (last && seconds_between(last->stamp, frame.stamp) > kLongestGap_s);
  pose_epoch_ = frame.pose_epoch;
  if (is_anew) forget();
  if (last && frame.stamp > last->stamp) {
    steps_mps_[step_count_++ % kSteps] =
        (p_world - last->p_world) / seconds_between(last->stamp, frame.stamp);
  }
  last = {frame.stamp, p_world};
  const Eigen::Vector3d ahead =
      (lookahead_s_ * velocity_mps()).cwiseMax(-farthest_m_).cwiseMin(farthest_m_);
  // The vehicle is within the limits of the map; its window's middle may not leave them either.
  const double most = std::nextafter(RollingMap::kMaxCoordinate_m, 0.0);
  return (p_world + ahead).cwiseMax(-most).cwiseMin(most);
}

}  // namespace swiftlet
