// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/ray_query.hpp"
#include "swiftlet/query/sweep/body_shape.hpp"
#include "swiftlet/query/sweep/sweep_path.hpp"

namespace swiftlet {

class DistanceField;

/// How a sweep is meant.
struct SweepPolicy {
  OccupancyThresholds thresholds{};             ///< where belief becomes a claim
  UnknownSpace unknown = UnknownSpace::kStops;  ///< kPasses: only matter counts
  double margin_m = 0.0;           ///< the body is taken to be larger by this on every side
  double clearance_reach_m = 0.0;  ///< look for the least clearance up to here; 0: do not look
  /// Of the same frame and thresholds: what it proves to be clear is not searched. The answer is
  /// the same, but for the 1/16 of a voxel to which contacts are told, and comes sooner.
  const DistanceField* field = nullptr;
};

/// What is in the way.
enum class SweepState : std::uint8_t {
  kClear,    ///< every voxel that the body touches is free
  kUnknown,  ///< it touches unknown voxels, but no occupied one
  kBlocked,  ///< it touches an occupied voxel
};

/// Where the body first touches a voxel.
struct SweepContact {
  Occupancy state = Occupancy::kUnknown;              ///< of the voxel
  VoxelIndex voxel;                                   ///< the voxel that is touched
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< centre of the voxel [m]
  double path_m = 0.0;     ///< the origin of the body is clear up to here, along the path
  std::size_t leg = 0;     ///< between poses `leg` and `leg` + 1,
  double leg_share = 0.0;  ///< at this share of the way
  Stamp stamp;             ///< 0 on a path without times
};

/// The tightest place of a path.
struct SweepClearance {
  double at_least_m = 0.0;  ///< no voxel that counts is nearer to the body (without margin), or the
                            ///< reach that was asked for
  std::optional<VoxelIndex> voxel;  ///< the nearest voxel; none within reach
  double path_m = 0.0;              ///< and where on the path
};

/// What a sweep found.
struct SweepAnswer {
  SweepState state = SweepState::kClear;  ///< whether the way is free
  std::optional<SweepContact> unknown;    ///< the first unknown voxel, if unknown space stops
  std::optional<SweepContact> occupied;   ///< the first occupied voxel
  double clear_m = 0.0;   ///< the path is clear up to here: its whole length, or the first contact
  double length_m = 0.0;  ///< of the path, up to there
  std::optional<SweepClearance> clearance;  ///< if a reach was given
};

/// May the body move along the path?
///
/// Conservative: kClear only if every voxel that any point of the body touches, at any time of the
/// path, is free; what lies outside the window is unknown. Tight: a body that would be clear if it
/// were larger by the diagonal of a voxel on every side is clear. Contacts are told to 1/16 of a
/// voxel and never late.
/// Errors: kUsage if margin or reach are negative, not finite or larger than the window, the body
/// reaches farther from its origin than the window, or the field is of another frame or kind.
/// Thread safety: any. Cost: what lies in the blocks that the body passes; free blocks cost one
/// look each. Does not allocate, unless it fails.
[[nodiscard]] Expected<SweepAnswer> sweep(const MapSnapshot& map, const BodyShape& body,
                                          const SweepPath& path, const SweepPolicy& policy = {});

/// How far the body may move from a pose straight along `course_world` (any length but 0), up to
/// `farthest_m`, before it touches a voxel that stops it. Errors: kUsage, as sweep().
[[nodiscard]] Expected<double> free_distance_along(const MapSnapshot& map, const BodyShape& body,
                                                   const Transform<World, Body>& T_world_body,
                                                   const Eigen::Vector3d& course_world,
                                                   double farthest_m,
                                                   const SweepPolicy& policy = {});

}  // namespace swiftlet
