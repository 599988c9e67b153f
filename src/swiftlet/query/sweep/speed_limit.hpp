// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// How a vehicle stops.
struct Braking {
  double deceleration_mps2 = 4.0;  ///< that it can hold; it may accelerate as hard, too
  double reaction_s = 0.3;         ///< from a frame's exposure until the vehicle brakes
};

/// The speed [m/s] from which the vehicle stops within `free_m` of free space ahead, as of
/// free_distance_along().
///
///     v = max(0, -2 a t + sqrt(2 a^2 t^2 + 2 a d))
///
/// The textbook has -a t + sqrt(a^2 t^2 + 2 a d), which holds for a vehicle that keeps its speed
/// while it reacts. One that still accelerates then, as it may below the limit, is faster by a t
/// and farther by a t^2 / 2 when it starts to brake: v t + a t^2 / 2 + (v + a t)^2 / (2 a) = d
/// gives the above. Below a t^2 no speed is safe; 0 is as safe as it gets. Errors: kUsage if a
/// number is negative or not finite (free_m may be infinite), or the deceleration is 0.
[[nodiscard]] Expected<double> speed_limit_mps(double free_m, const Braking& braking);

}  // namespace swiftlet
