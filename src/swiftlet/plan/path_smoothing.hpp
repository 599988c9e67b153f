// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "swiftlet/plan/motion_check.hpp"
#include "swiftlet/plan/plan_options.hpp"

namespace swiftlet {

/// Makes a way that is clear shorter: leaves out corners, the farthest first, wherever the straight
/// way is clear and as good. A straight way is as good if it nowhere has less room than
/// `comfort_m`, or than the way that it replaces. Ends stay.
[[nodiscard]] std::vector<Eigen::Vector3d> shortened(const MotionCheck& check,
                                                     std::vector<Eigen::Vector3d> points,
                                                     double comfort_m);

/// Makes a way that is clear smooth, and pushes it away from what is nearer than `comfort_m`: an
/// elastic band (Quinlan and Khatib, 1993) in the distance field. A point moves only where both of
/// its legs stay clear, and within the bounds, so the result is as clear as what was given. Ends
/// stay; points come to be two voxels apart or a little more.
[[nodiscard]] std::vector<Eigen::Vector3d> smoothed(const MotionCheck& check,
                                                    const std::vector<Eigen::Vector3d>& points,
                                                    double comfort_m,
                                                    const std::optional<SpaceBox>& bounds = {});

}  // namespace swiftlet
