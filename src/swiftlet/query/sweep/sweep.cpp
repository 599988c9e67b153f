// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "swiftlet/query/sweep/sweep_search_private.hpp"

namespace swiftlet {
namespace {

/// The diagonal of the window [m]: nothing larger makes sense, and it bounds the work.
double window_diagonal_m(const MapSnapshot& map) {
  const BlockIndex& n = map.window().size;
  return map.voxel_m() * kBlockEdge * Eigen::Vector3d(n.x, n.y, n.z).norm();
}

Status check_sweep(const MapSnapshot& map, const BodyShape& body, const SweepPolicy& policy) {
  const double largest_m = window_diagonal_m(map);
  const auto is_usable = [&](double v) { return v >= 0.0 && v <= largest_m; };  // no NaN
  if (!is_usable(policy.margin_m) || !is_usable(policy.clearance_reach_m)) {
    return fail(
        ErrorCode::kUsage, "sweep",
        fmt::format("margin_m {} or clearance_reach_m {} cannot be used", policy.margin_m,
                    policy.clearance_reach_m),
        fmt::format("choose values from 0 to {:.1f}, the diagonal of the window", largest_m));
  }
  if (body.reach_m() > largest_m) {
    return fail(ErrorCode::kUsage, "sweep",
                fmt::format("the body reaches {:.1f} m from its origin, farther than the window "
                            "of {:.1f} m across",
                            body.reach_m(), largest_m),
                "make the body smaller or map.size_m larger");
  }
  return Done{};
}

/// A field that is not of this map would prove what is not so.
Status check_field(const MapSnapshot& map, const SweepPolicy& policy) {
  if (policy.field == nullptr) return Done{};
  const DistanceField& field = *policy.field;
  const bool is_occupied = obstacles_of(policy) == Obstacles::kOccupied;
  const bool is_of_map = field.frame_count() == map.frame_count() &&
                         field.voxel_m() == map.voxel_m() &&
                         field.options().thresholds == policy.thresholds;
  if (!is_of_map) {
    return fail(ErrorCode::kUsage, "sweep",
                "the field is of another frame, voxel or thresholds than the map",
                "update() it with the same snapshot, or sweep without it");
  }
  // Nothing is known of what lies beyond its box; unknown space stops there all the same.
  const bool knows_all = field.box() == map.window();
  const bool answers =
      is_occupied ? field.options().occupied && knows_all : field.options().not_free;
  if (answers) return Done{};
  return fail(ErrorCode::kUsage, "sweep",
              "the field does not know the obstacles that stop the body",
              "make it with `occupied` and a box as large as the window, or with `not_free`");
}

/// Calls visit(leg, number, length so far [m]) along a path; a single pose is a leg without length.
template <class Visit>
double for_each_leg(const SweepPath& path, double voxels_per_m, Visit&& visit) {
  double length_m = 0.0;
  const std::size_t legs = std::max<std::size_t>(path.size() - 1, 1);
  for (std::size_t i = 0; i < legs; ++i) {
    const PathLeg leg(path.pose(i), path.pose(std::min(i + 1, path.size() - 1)), voxels_per_m);
    visit(leg, i, length_m);
    length_m += leg.length() / voxels_per_m;
  }
  return length_m;
}

/// The time at a contact, between the stamps of its leg; as whole numbers, since stamps are larger
/// than a double is exact.
void set_stamp(const SweepPath& path, std::optional<SweepContact>& contact) {
  if (!contact) return;
  const Stamp from = path.stamp(contact->leg);
  const Stamp to = path.stamp(std::min(contact->leg + 1, path.size() - 1));
  const auto span = static_cast<std::uint64_t>(to.ns) - static_cast<std::uint64_t>(from.ns);
  const auto share = static_cast<std::uint64_t>(contact->leg_share * static_cast<double>(span));
  contact->stamp = {
      static_cast<std::int64_t>(static_cast<std::uint64_t>(from.ns) + std::min(share, span))};
}

}  // namespace

Expected<SweepAnswer> sweep(const MapSnapshot& map, const BodyShape& body, const SweepPath& path,
                            const SweepPolicy& policy) {
  if (auto usable = check_sweep(map, body, policy); !usable)
    return forward_error(std::move(usable));
  if (auto usable = check_field(map, policy); !usable) return forward_error(std::move(usable));
  const SweepScene scene(map, body, policy);
  SweepAnswer answer;
  ContactSearch contacts(scene);
  bool is_searching = true;
  answer.length_m =
      for_each_leg(path, scene.voxels_per_m, [&](const PathLeg& leg, std::size_t i, double so_far) {
        if (is_searching) is_searching = contacts.follow(leg, i, so_far);
      });
  answer.unknown = contacts.unknown();
  answer.occupied = contacts.occupied();
  set_stamp(path, answer.unknown);
  set_stamp(path, answer.occupied);
  answer.state = answer.occupied  ? SweepState::kBlocked
                 : answer.unknown ? SweepState::kUnknown
                                  : SweepState::kClear;
  answer.clear_m = answer.length_m;
  for (const auto& contact : {answer.unknown, answer.occupied}) {
    if (contact) answer.clear_m = std::min(answer.clear_m, contact->path_m);
  }
  if (policy.clearance_reach_m > 0.0) {
    ClearanceSearch clearance(scene);
    for_each_leg(path, scene.voxels_per_m, [&](const PathLeg& leg, std::size_t, double so_far) {
      clearance.follow(leg, so_far);
    });
    answer.clearance = clearance.answer();
  }
  return answer;
}

Expected<double> free_distance_along(const MapSnapshot& map, const BodyShape& body,
                                     const Transform<World, Body>& T_world_body,
                                     const Eigen::Vector3d& course_world, double farthest_m,
                                     const SweepPolicy& policy) {
  const double length = course_world.norm();
  if (!(length > 0.0) || !std::isfinite(length) || !(farthest_m >= 0.0)) {
    return fail(ErrorCode::kUsage, "course", "has no direction, or the distance is negative",
                "give a finite vector that is not 0, and a distance in metres");
  }
  const Eigen::Vector3d end = T_world_body.translation() + farthest_m / length * course_world;
  const std::array<TimedPose, 2> poses{
      TimedPose{{}, T_world_body},
      TimedPose{{}, Transform<World, Body>::trusted(T_world_body.rotation(), end)}};
  const auto path = SweepPath::of(poses);
  if (!path) return tl::make_unexpected(path.error());
  const auto answer = sweep(map, body, *path, policy);
  if (!answer) return tl::make_unexpected(answer.error());
  return answer->clear_m;
}

}  // namespace swiftlet
