// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/sweep/speed_limit.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

Expected<double> speed_limit_mps(double free_m, const Braking& braking) {
  const double a = braking.deceleration_mps2, t = braking.reaction_s;
  const bool is_sound =
      free_m >= 0.0 && a > 0.0 && std::isfinite(a) && t >= 0.0 && std::isfinite(t);
  if (!is_sound) {
    return fail(ErrorCode::kUsage, "speed limit", "a distance, deceleration or time cannot be used",
                "give numbers that are not negative, and a deceleration above 0");
  }
  return std::max(0.0, -2.0 * a * t + std::sqrt(2.0 * a * a * t * t + 2.0 * a * free_m));
}

}  // namespace swiftlet
