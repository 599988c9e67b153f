// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/plan_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "swiftlet/plan/motion_check.hpp"
#include "swiftlet/plan/path_search_private.hpp"
#include "swiftlet/plan/path_smoothing.hpp"
#include "swiftlet/plan/reachable_space.hpp"
#include "swiftlet/query/occupancy_query.hpp"

namespace swiftlet {
namespace {

std::string text_of(const Eigen::Vector3d& p) {
  return fmt::format("{:.2f},{:.2f},{:.2f}", p.x(), p.y(), p.z());
}

SpaceBox window_of(const MapSnapshot& map) {
  const VoxelBox voxels = voxel_box(map.window());
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * map.voxel_m());
  return {centre_of(voxels.first, map.voxel_m()) - half,
          centre_of(voxels.last, map.voxel_m()) + half};
}

/// Where the search may go: the bounds, or the window, and beyond it to the ends if unknown space
/// passes.
Expected<SpaceBox> space_for(const MapSnapshot& map, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to, const PlanOptions& options) {
  const SpaceBox window = window_of(map);
  SpaceBox space = options.bounds.value_or(window);
  if (!((space.high - space.low).array() > 0.0).all() || !space.low.allFinite() ||
      !space.high.allFinite()) {
    return fail(ErrorCode::kUsage, "bounds", "the box that the path may lead through is empty",
                "give its lower corner first, in metres");
  }
  if (options.sweep.unknown == UnknownSpace::kPasses && !options.bounds)
    space = {space.low.cwiseMin(from).cwiseMin(to), space.high.cwiseMax(from).cwiseMax(to)};
  for (const auto& [name, p] : {std::pair{"from", from}, std::pair{"to", to}}) {
    const bool is_known = options.sweep.unknown == UnknownSpace::kPasses || window.contains(p);
    if (is_known && space.contains(p)) continue;
    const SpaceBox& box = is_known ? space : window;
    return fail(ErrorCode::kUsage, name,
                fmt::format("{} lies outside {}, which reaches from {} to {}", text_of(p),
                            is_known ? "the bounds of the path" : "the window of the map",
                            text_of(box.low), text_of(box.high)),
                is_known ? "widen the bounds" : "choose a place inside, or let unknown space pass");
  }
  return space;
}

std::string touch_of(const MotionCheck& check, const Eigen::Vector3d& p,
                     const SweepAnswer& answer) {
  const SweepContact& contact = answer.occupied ? *answer.occupied : *answer.unknown;
  return fmt::format(
      "at {} the body, {:.2f} m from its middle to its rim, would touch the {} voxel at {}",
      text_of(p), check.body().reach_m() + check.policy().margin_m,
      answer.occupied ? "occupied" : "unknown", text_of(contact.p_world));
}

/// Whether the body may be at an end of the path, and if not, why.
Status check_end(const MotionCheck& check, std::string_view name, const Eigen::Vector3d& p) {
  const std::array place{p};
  const auto path = SweepPath::along(place);
  if (!path)
    return tl::make_unexpected(
        Error{ErrorCode::kUsage, std::string(name), path.error().what, path.error().remedy});
  const auto answer = sweep(check.map(), check.body(), *path, check.policy());
  if (!answer) return tl::make_unexpected(answer.error());
  if (answer->state == SweepState::kClear) return Done{};
  const Occupancy here = occupancy_at(check.map(), p, check.policy().thresholds);
  if (here == Occupancy::kOccupied) {
    return fail(ErrorCode::kUsage, std::string(name),
                fmt::format("{} is inside an obstacle", text_of(p)), "choose another place");
  }
  if (here == Occupancy::kUnknown && answer->unknown) {
    return fail(ErrorCode::kUsage, std::string(name), fmt::format("{} was never seen", text_of(p)),
                "look there first, or let unknown space pass");
  }
  return fail(ErrorCode::kUsage, std::string(name), touch_of(check, p, *answer),
              "move it, or make the body or the margin smaller");
}

Error no_way(const MotionCheck& check, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             const PlanOptions& options) {
  ReachableSpace space;
  space.flood(check.field(), check.obstacles(), from, check.map().voxel_m());
  const bool is_outside = !check.field().contains(voxel_containing(to, check.map().voxel_m()));
  if (!is_outside && !space.path_m(to)) {
    return {ErrorCode::kNotFound, "plan",
            fmt::format("there is no way from {} to {}: nothing but walls{} between them",
                        text_of(from), text_of(to),
                        check.obstacles() == Obstacles::kNotFree ? " and unknown space" : ""),
            "map more, or choose another goal"};
  }
  return {ErrorCode::kNotFound, "plan",
          fmt::format("no way from {} to {} was found in {} iterations", text_of(from), text_of(to),
                      options.max_iterations),
          "there may be none for a body of this size; a smaller body or margin, or more "
          "iterations, may find one"};
}

/// A way on the grid, along whose voxels the ball around the body is clear; empty if there is none.
std::vector<Eigen::Vector3d> way_on_the_grid(const MotionCheck& check, const Eigen::Vector3d& from,
                                             const Eigen::Vector3d& to) {
  const double voxel_m = check.map().voxel_m();
  ReachableSpace space;
  const double radius_m = check.body().reach_m() + check.policy().margin_m;
  space.flood(check.field(), check.obstacles(), from, room_for_ball_m(radius_m, voxel_m));
  std::vector<Eigen::Vector3d> way;
  for (const VoxelIndex& v : space.way_to(voxel_containing(to, voxel_m)))
    way.push_back(centre_of(v, voxel_m));
  return way;
}

Expected<std::vector<Eigen::Vector3d>> corners_of(PathQuestion question) {
  if (question.check.is_clear(question.from, question.to))
    return std::vector{question.from, question.to};
  question.guide = way_on_the_grid(question.check, question.from, question.to);
  auto corners = search_path(question);
  if (!corners) return forward_error(std::move(corners));
  if (corners->empty())
    return tl::make_unexpected(
        no_way(question.check, question.from, question.to, question.options));
  return corners;
}

Expected<PlannedPath> finished(const MotionCheck& check, std::vector<Eigen::Vector3d> points,
                               const PlanOptions& options) {
  SweepPolicy policy = options.sweep;
  policy.clearance_reach_m = options.comfort_m + options.sweep.margin_m;
  const auto path = SweepPath::along(points);
  if (!path) return tl::make_unexpected(path.error());
  const auto answer = sweep(check.map(), check.body(), *path, policy);
  if (!answer) return tl::make_unexpected(answer.error());
  if (answer->state != SweepState::kClear) {
    return fail(ErrorCode::kUsage, "plan", "the path that was found is not clear in the map",
                "give the field of this map, updated with it");
  }
  PlannedPath planned;
  planned.points = std::move(points);
  planned.length_m = answer->length_m;
  if (answer->clearance) planned.tightest = *answer->clearance;
  planned.frame_count = check.map().frame_count();
  return planned;
}

Status check_numbers(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                     const PlanOptions& options) {
  for (const auto& [name, p] : {std::pair{"from", from}, std::pair{"to", to}}) {
    if (p.allFinite()) continue;
    return fail(ErrorCode::kUsage, name, "the place is not a finite number of metres",
                "give x, y and z");
  }
  const auto is_usable = [](double v) { return v >= 0.0 && v <= 10.0; };  // no NaN
  if (!is_usable(options.comfort_m) || !is_usable(options.sweep.margin_m) ||
      options.max_iterations < 1) {
    return fail(ErrorCode::kUsage, "plan",
                "the comfort, the margin or the number of iterations cannot be used",
                "give 0 to 10 m, and at least one iteration");
  }
  return Done{};
}

}  // namespace

bool can_plan() { return SWIFTLET_HAS_OMPL != 0; }

Expected<PlannedPath> plan_path(const MapSnapshot& map, const DistanceField& field,
                                const BodyShape& body, const Eigen::Vector3d& from_world,
                                const Eigen::Vector3d& to_world, const PlanOptions& options) {
  if (auto sound = check_numbers(from_world, to_world, options); !sound)
    return forward_error(std::move(sound));
  if (field.frame_count() != map.frame_count()) {
    return fail(ErrorCode::kUsage, "plan",
                fmt::format("the field is of frame {}, the map of frame {}", field.frame_count(),
                            map.frame_count()),
                "update() it with this snapshot");
  }
  if (field.voxel_m() != map.voxel_m()) {
    return fail(ErrorCode::kUsage, "plan",
                fmt::format("the field has voxels of {} m, the map of {} m", field.voxel_m(),
                            map.voxel_m()),
                "update() it with this snapshot");
  }
  const auto space = space_for(map, from_world, to_world, options);
  if (!space) return tl::make_unexpected(space.error());
  const MotionCheck check(map, field, body, options.sweep);
  if (auto clear = check_end(check, "from", from_world); !clear)
    return forward_error(std::move(clear));
  if (auto clear = check_end(check, "to", to_world); !clear) return forward_error(std::move(clear));
  auto corners = corners_of({check, from_world, to_world, *space, options});
  if (!corners) return forward_error(std::move(corners));
  auto points = shortened(check, std::move(*corners), options.comfort_m);
  return finished(check, smoothed(check, points, options.comfort_m, options.bounds), options);
}

Expected<PlannedPath> plan_path(const MapSnapshot& map, const BodyShape& body,
                                const Eigen::Vector3d& from_world, const Eigen::Vector3d& to_world,
                                const PlanOptions& options) {
  if (auto sound = check_numbers(from_world, to_world, options); !sound)
    return forward_error(std::move(sound));
  DistanceFieldOptions field_options;
  field_options.max_distance_m = std::min(
      body.reach_m() + options.sweep.margin_m + options.comfort_m + 1.0, 254.0 * map.voxel_m());
  field_options.not_free = options.sweep.unknown == UnknownSpace::kStops;
  field_options.occupied = !field_options.not_free;
  field_options.thresholds = options.sweep.thresholds;
  auto field = DistanceField::create(map.voxel_m(), map.window().size, field_options);
  if (!field) return forward_error(std::move(field));
  field->update(map);
  return plan_path(map, *field, body, from_world, to_world, options);
}

}  // namespace swiftlet
