// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <vector>

#include "swiftlet/eval/truth/sight_line.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/sim/ray_caster.hpp"

namespace swiftlet::eval {

/// Which lines of sight count: those that the camera under test could give a reading for.
struct SightOptions {
  int stride_px = 4;  ///< every so manieth row and column
  double min_range_m = 0.2;
  double max_range_m = 10.0;  ///< depth along the optical axis; what lies behind is no evidence
  /// Steeper than 80 degrees of incidence the simulated matcher begins to fail.
  double min_cos_incidence = 0.17;
};

/// A camera at a true pose.
struct TrueView {
  const PinholeIntrinsics& intrinsics;
  const Transform<World, Camera>& T_world_camera;
};

/// The lines of sight of one view, row by row; replaces what `lines` held.
void lines_of_sight(const sim::RayCaster& world, const TrueView& view, const SightOptions& options,
                    std::vector<SightLine>& lines);

/// For each point [m, world]: its depth [m] if it lies in view, in range, and nothing that is
/// farther than `own_radius_m` from it stands before it; else 0.
void depths_in_view(const sim::RayCaster& world, const TrueView& view, const SightOptions& options,
                    std::span<const Eigen::Vector3f> points_m, float own_radius_m,
                    std::span<float> depths_m);

}  // namespace swiftlet::eval
