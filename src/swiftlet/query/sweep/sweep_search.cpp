// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>
#include <limits>

#include "swiftlet/query/sweep/sweep_search_private.hpp"

namespace swiftlet {
namespace {

// A contact is looked at closer until its piece of the path is so short, and turns move the body by
// no more. [voxels]
constexpr double kFine_voxels = 1.0 / 16.0;
constexpr double kShortestShare = 1e-12;  // rounding; the voxels of a leg are fewer

// The coarse pieces. [voxels]
constexpr double kLongest_voxels = 8.0;
constexpr double kGrowth_voxels = 1.0;

double longest_piece(double reach) { return std::max(kLongest_voxels, 2.0 * reach); }

/// The point of a part that lies farthest to one side of an axis, `sign` 1 or -1.
Eigen::Array3d end_along(const MovingPart& part, Eigen::Index axis, double sign) {
  Eigen::Vector3d end = part.centre;
  for (const Eigen::Vector3d& half : part.half) end += half[axis] * sign < 0.0 ? -half : half;
  end[axis] += sign * (part.radius + kSlack_voxels);
  return end.array();
}

/// The voxel of a part that lies farthest outside the window. REQUIRES: some point of it does.
VoxelIndex outermost_voxel(const MovingPart& part, const VoxelBox& window) {
  const Eigen::Array3d first(window.first.x, window.first.y, window.first.z);
  const Eigen::Array3d end(window.last.x + 1.0, window.last.y + 1.0, window.last.z + 1.0);
  Eigen::Array3d farthest = part.centre.array();
  double most = -std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Array3d low = end_along(part, axis, -1.0), high = end_along(part, axis, 1.0);
    const double below = first[axis] - low[axis], above = high[axis] - end[axis];
    if (std::max(below, above) <= most) continue;
    most = std::max(below, above);
    farthest = below > above ? low : high;
  }
  const auto index = [](double v) {
    constexpr double kFarthest = 2147483000.0;
    return static_cast<std::int32_t>(std::clamp(std::floor(v), -kFarthest, kFarthest));
  };
  return {index(farthest.x()), index(farthest.y()), index(farthest.z())};
}

}  // namespace

Clip SweepScene::near_window(const PathLeg& leg, double extra) const {
  // One voxel more than needed: what rounding leaves out is outside for certain.
  const double around = std::ceil(reach + extra) + 1.0;
  const auto grow = [&](std::int32_t v, double by) {
    constexpr double kFarthest = 2147483000.0;
    return static_cast<std::int32_t>(std::clamp(v + by, -kFarthest, kFarthest));
  };
  const VoxelBox box{
      {grow(window.first.x, -around), grow(window.first.y, -around), grow(window.first.z, -around)},
      {grow(window.last.x, around), grow(window.last.y, around), grow(window.last.z, around)}};
  return clip_to_box({leg.from(), leg.at(1.0)}, box);
}

ContactSearch::ContactSearch(const SweepScene& scene) : scene_(scene), wanted_(scene.stopping()) {
  if (scene.policy.field == nullptr) return;
  by_field_.emplace(*scene.policy.field, obstacles_of(scene.policy), scene.reach + scene.margin);
}

std::optional<ContactSearch::Touch> ContactSearch::touch_of(const MovingPart& part) const {
  const Eigen::Array3d extent = part.half_extent();
  const TouchedVoxels voxels =
      touched_voxels(part.centre.array() - extent, part.centre.array() + extent, scene_.window);
  if (wanted_.is_unknown && !voxels.is_inside)
    return Touch{outermost_voxel(part, scene_.window), Occupancy::kUnknown};
  if (!voxels.is_any) return std::nullopt;
  std::optional<Touch> found;
  find_voxel(
      {scene_.map, scene_.policy.thresholds, wanted_}, voxels.box,
      [&](const BlockIndex& block) { return !may_touch(part, cube_of(block)); },
      [&](const VoxelIndex& voxel, Occupancy state) {
        if (!may_touch(part, cube_of(voxel))) return false;
        found = Touch{voxel, state};
        return true;
      });
  return found;
}

std::optional<ContactSearch::Touch> ContactSearch::touch(const PathLeg& leg, double begin,
                                                         double end) const {
  const PathLeg::Placement placement = leg.piece(begin, end, scene_.lever);
  for (const BodyShape::Part& part : scene_.body.parts()) {
    if (const auto found = touch_of(leg.moving(part, placement, scene_.margin))) return found;
  }
  return std::nullopt;
}

void ContactSearch::keep(const PathLeg& leg, double share, const Touch& touch) {
  SweepContact contact;
  contact.state = touch.state;
  contact.voxel = touch.voxel;
  contact.p_world = centre_of(touch.voxel, scene_.map.voxel_m());
  contact.path_m = length_so_far_m_ + share * leg.length() / scene_.voxels_per_m;
  contact.leg = number_;
  contact.leg_share = share;
  const bool is_occupied = touch.state == Occupancy::kOccupied;
  (is_occupied ? occupied_ : unknown_) = contact;
  (is_occupied ? wanted_.is_occupied : wanted_.is_unknown) = false;
}

void ContactSearch::search(const PathLeg& leg, double begin, double end) {
  if (!wanted_.is_any()) return;
  const auto found = touch(leg, begin, end);
  if (!found) return;
  const double share = end - begin;
  const bool is_fine =
      share * leg.length() <= kFine_voxels && leg.growth(share, scene_.lever) <= kFine_voxels;
  if (is_fine || share < kShortestShare) {
    keep(leg, begin, *found);
    return search(leg, begin, end);  // the other kind may be met here, too
  }
  const double middle = begin + 0.5 * share;
  search(leg, begin, middle);
  search(leg, middle, end);
}

bool ContactSearch::search_pieces(const PathLeg& leg, double begin, double end) {
  return for_each_piece(leg, begin, end, longest_piece(scene_.reach + scene_.margin), scene_.lever,
                        kGrowth_voxels, [&](double from, double to) {
                          search(leg, from, to);
                          return wanted_.is_any();
                        });
}

bool ContactSearch::follow(const PathLeg& leg, std::size_t number, double length_so_far_m) {
  number_ = number;
  length_so_far_m_ = length_so_far_m;
  const Clip clip = scene_.near_window(leg, scene_.margin);
  const bool starts_outside = clip.is_empty() || clip.begin > 0.0;
  if (starts_outside && wanted_.is_unknown) {
    keep(leg, 0.0,
         {voxel_containing(leg.from() / scene_.voxels_per_m, scene_.map.voxel_m()),
          Occupancy::kUnknown});
  }
  if (clip.is_empty()) return wanted_.is_any();
  if (!by_field_) return search_pieces(leg, clip.begin, clip.end);
  return by_field_->for_each_unsure(leg, clip.begin, clip.end, [&](double begin, double end) {
    return search_pieces(leg, begin, end);
  });
}

void ClearanceSearch::look_at_rim(const MovingPart& part, double path_m) {
  const Eigen::Array3d extent = part.half_extent();
  const VoxelBox& window = scene_.window;
  const Eigen::Array3d first(window.first.x, window.first.y, window.first.z);
  const Eigen::Array3d end(window.last.x + 1.0, window.last.y + 1.0, window.last.z + 1.0);
  const double below = (part.centre.array() - extent - first).minCoeff();
  const double above = (end - part.centre.array() - extent).minCoeff();
  const double gap = std::max(0.0, std::min(below, above));
  if (gap >= least_) return;
  least_ = gap;
  path_m_ = path_m;
  MovingPart larger = part;
  larger.radius += gap + 0.5;  // reaches over the rim: its outermost voxel is the nearest outside
  voxel_ = outermost_voxel(larger, window);
}

void ClearanceSearch::search(const PathLeg& leg, double begin, double end, double length_so_far_m) {
  const PathLeg::Placement placement = leg.piece(begin, end, scene_.lever);
  const auto path_at = [&](double share) {
    return length_so_far_m + share * leg.length() / scene_.voxels_per_m;
  };
  for (const BodyShape::Part& body_part : scene_.body.parts()) {
    const MovingPart part = leg.moving(body_part, placement, 0.0);
    if (scene_.stopping().is_unknown) look_at_rim(part, path_at(begin));
    const Eigen::Array3d extent = part.half_extent() + least_;
    const TouchedVoxels voxels =
        touched_voxels(part.centre.array() - extent, part.centre.array() + extent, scene_.window);
    if (!voxels.is_any) continue;
    find_voxel(
        {scene_.map, scene_.policy.thresholds, scene_.stopping()}, voxels.box,
        [&](const BlockIndex& block) {
          return gap_between(part, cube_of(block), least_).at_least >= least_;
        },
        [&](const VoxelIndex& voxel, Occupancy) {
          const Gap gap = gap_between(part, cube_of(voxel), least_);
          if (gap.at_least >= least_) return false;
          least_ = gap.at_least;
          voxel_ = voxel;
          path_m_ = path_at(begin + 0.5 * (1.0 + gap.along) * (end - begin));
          return least_ == 0.0;
        });
  }
}

void ClearanceSearch::follow(const PathLeg& leg, double length_so_far_m) {
  constexpr double kGrowth = 0.25;  // what the turn within a piece may cost of the answer
  const Clip clip = scene_.near_window(leg, least_);
  if (clip.is_empty() || clip.begin > 0.0) {
    if (scene_.stopping().is_unknown) {  // somewhere else entirely: nothing is known there
      least_ = 0.0;
      voxel_ = voxel_containing(leg.from() / scene_.voxels_per_m, scene_.map.voxel_m());
      path_m_ = length_so_far_m;
    }
  }
  if (clip.is_empty()) return;
  for_each_piece(leg, clip.begin, clip.end, longest_piece(scene_.reach + least_), scene_.lever,
                 kGrowth, [&](double begin, double end) {
                   search(leg, begin, end, length_so_far_m);
                   return least_ > 0.0;
                 });
}

SweepClearance ClearanceSearch::answer() const {
  return {least_ / scene_.voxels_per_m, voxel_, path_m_};
}

}  // namespace swiftlet
