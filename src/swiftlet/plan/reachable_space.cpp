// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/reachable_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kFaceStep = 10, kEdgeStep = 14;  // tenths of a voxel
enum Room : std::uint8_t { kNotAsked, kNone, kEnough };

/// Calls visit(VoxelIndex, cost of the step) for the 18 voxels that share a face or an edge.
template <class Visit>
void for_each_neighbour(const VoxelIndex& v, Visit&& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      VoxelIndex face = v;
      (axis == 0 ? face.x : axis == 1 ? face.y : face.z) += step;
      visit(face, kFaceStep);
      for (const int aside : {-1, 1}) {
        VoxelIndex edge = face;
        (axis == 0 ? edge.y : axis == 1 ? edge.z : edge.x) += aside;
        visit(edge, kEdgeStep);
      }
    }
  }
}

}  // namespace

std::optional<std::size_t> ReachableSpace::index_of(const VoxelIndex& v) const {
  if (cost_.empty() || !box_.contains(v)) return std::nullopt;
  return static_cast<std::size_t>(v.x - box_.first.x) +
         row_ * static_cast<std::size_t>(v.y - box_.first.y) +
         slab_ * static_cast<std::size_t>(v.z - box_.first.z);
}

void ReachableSpace::flood(const DistanceField& field, Obstacles obstacles,
                           const Eigen::Vector3d& from_world, double least_m) {
  voxel_m_ = field.voxel_m();
  box_ = voxel_box(field.box());
  row_ = static_cast<std::size_t>(box_.last.x - box_.first.x + 1);
  slab_ = row_ * static_cast<std::size_t>(box_.last.y - box_.first.y + 1);
  const std::size_t count = slab_ * static_cast<std::size_t>(box_.last.z - box_.first.z + 1);
  cost_.assign(count, kFar);
  has_room_.assign(count, kNotAsked);
  queue_.resize(kEdgeStep + 1);
  reached_ = 0;
  const VoxelIndex from = voxel_containing(from_world, voxel_m_);
  if (!field.contains(from)) return;
  offer(from, 0);
  spread(field, obstacles, from, least_m);
}

void ReachableSpace::offer(const VoxelIndex& v, std::uint32_t cost) {
  const auto index = index_of(v);
  if (!index || cost >= cost_[*index] || has_room_[*index] == kNone) return;
  cost_[*index] = cost;
  queue_[cost % queue_.size()].push_back({v, cost});
}

void ReachableSpace::spread(const DistanceField& field, Obstacles obstacles, const VoxelIndex& from,
                            double least_m) {
  const double here_m = field.distance(from, obstacles).distance_m;
  const double near_voxels = 2.0 * least_m / voxel_m_;
  const auto has_room_at = [&](const VoxelIndex& v) {
    const double room_m = field.distance(v, obstacles).distance_m;
    if (room_m >= least_m || room_m < here_m || room_m <= 0.0) return room_m >= least_m;
    return std::hypot(v.x - from.x, v.y - from.y, v.z - from.z) <= near_voxels;
  };
  std::size_t empty_in_a_row = 0;
  std::vector<Entry> now;
  for (std::uint32_t cost = 0; empty_in_a_row <= queue_.size(); ++cost) {
    now.clear();
    now.swap(queue_[cost % queue_.size()]);
    empty_in_a_row = now.empty() ? empty_in_a_row + 1 : 0;
    for (const Entry& entry : now) {
      const std::size_t index = *index_of(entry.voxel);
      if (entry.cost != cost_[index] || has_room_[index] == kEnough) continue;
      const bool has_room = has_room_at(entry.voxel);
      has_room_[index] = has_room ? kEnough : kNone;
      if (!has_room) {
        cost_[index] = kFar;
        continue;
      }
      ++reached_;
      for_each_neighbour(entry.voxel, [&](const VoxelIndex& next, std::uint32_t step) {
        offer(next, cost + step);
      });
    }
  }
}

std::optional<double> ReachableSpace::path_m(const VoxelIndex& v) const {
  const auto index = index_of(v);
  if (!index || has_room_[*index] != kEnough) return std::nullopt;
  return 0.1 * cost_[*index] * voxel_m_;
}

std::vector<VoxelIndex> ReachableSpace::way_to(const VoxelIndex& v) const {
  std::vector<VoxelIndex> way;
  if (!path_m(v)) return way;
  way.push_back(v);
  for (std::uint32_t cost = cost_[*index_of(v)]; cost > 0;) {
    std::optional<VoxelIndex> before;
    for_each_neighbour(way.back(), [&](const VoxelIndex& next, std::uint32_t step) {
      const auto index = index_of(next);
      if (!before && index && has_room_[*index] == kEnough && cost_[*index] + step == cost)
        before = next;
    });
    way.push_back(*before);  // what the cost came from
    cost = cost_[*index_of(*before)];
  }
  std::ranges::reverse(way);
  return way;
}

std::optional<double> ReachableSpace::path_m(const Eigen::Vector3d& p_world) const {
  return path_m(voxel_containing(p_world, voxel_m_));
}

}  // namespace swiftlet
