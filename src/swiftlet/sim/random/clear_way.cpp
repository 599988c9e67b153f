// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/random/clear_way.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include "swiftlet/sim/vehicle/triangle_distance.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

constexpr double kStep_m = 0.15;
// Marching never goes less than twice this: between two places it looks at, the clearance may be
// smaller by half of a march.
constexpr double kSlack_m = 0.01;

/// The places start + i kStep_m within the bounds, and what the search knows of each.
class WayGrid {
 public:
  struct Node {
    float cost_m = std::numeric_limits<float>::infinity();
    float room_m = std::numeric_limits<float>::quiet_NaN();  // see WaySearch::room_m()
    std::int32_t from = -1;
    bool is_done = false;
  };
  WayGrid(const Vector3d& start_m, const Eigen::AlignedBox3d& bounds_m) : start_m_(start_m) {
    for (int axis = 0; axis < 3; ++axis) {
      first_[axis] = static_cast<int>(std::ceil((bounds_m.min()[axis] - start_m[axis]) / kStep_m));
      size_[axis] = 1 - first_[axis] +
                    static_cast<int>(std::floor((bounds_m.max()[axis] - start_m[axis]) / kStep_m));
    }
    nodes_.resize(static_cast<std::size_t>(size_.prod()));
  }

  [[nodiscard]] Node& operator[](std::int32_t node) {
    return nodes_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Vector3d place(std::int32_t node) const {
    return start_m_ + kStep_m * (first_ + at(node)).cast<double>();
  }
  /// The nearest node; one at the rim if the place lies outside.
  [[nodiscard]] std::int32_t nearest(const Vector3d& p) const {
    const Eigen::Vector3i step = ((p - start_m_) / kStep_m).array().round().cast<int>();
    const Eigen::Vector3i last = size_ - Eigen::Vector3i::Ones();
    return number((step - first_).cwiseMax(0).cwiseMin(last));
  }
  /// The node beside another; -1 outside.
  [[nodiscard]] std::int32_t beside(std::int32_t node, const Eigen::Vector3i& step) const {
    const Eigen::Vector3i next = at(node) + step;
    const bool is_inside = (next.array() >= 0).all() && (next.array() < size_.array()).all();
    return is_inside ? number(next) : -1;
  }

 private:
  [[nodiscard]] Eigen::Vector3i at(std::int32_t node) const {
    return {node % size_.x(), node / size_.x() % size_.y(), node / (size_.x() * size_.y())};
  }
  [[nodiscard]] std::int32_t number(const Eigen::Vector3i& i) const {
    return i.x() + size_.x() * (i.y() + size_.y() * i.z());
  }

  Vector3d start_m_;
  Eigen::Vector3i first_, size_;
  std::vector<Node> nodes_;
};

class WaySearch {
 public:
  WaySearch(const RayCaster& world, const Vector3d& start_m, const WayLimits& limits)
      : world_(world),
        limits_(limits),
        grid_(start_m, limits.bounds_m),
        start_(grid_.nearest(start_m)) {}

  std::optional<std::vector<Vector3d>> to(const Vector3d& goal_m) {
    const std::int32_t goal = grid_.nearest(goal_m);
    if (room_of(goal) < 0.0F || room_of(start_) < 0.0F) return std::nullopt;
    reach(start_, -1, 0.0F, goal);
    while (!queue_.empty()) {
      const std::int32_t node = queue_.top().second;
      queue_.pop();
      if (grid_[node].is_done) continue;
      grid_[node].is_done = true;
      if (node == goal) return straightened(path_to(goal));
      expand(node, goal);
    }
    return std::nullopt;
  }

 private:
  /// How much farther than need be the nearest surface is, at most kStep_m; < 0: not allowed.
  [[nodiscard]] float room_m(const Vector3d& p) const {
    if (!limits_.bounds_m.contains(p)) return -1.0F;
    const double needed_m = limits_.clearance_m + kSlack_m;
    double least_m = needed_m + kStep_m;
    world_.search_near(p.cast<float>(), static_cast<float>(least_m), [&](const Triangle& t) {
      least_m = std::min(least_m, distance(p, in_double(t)));
      return least_m < needed_m ? 0.0F : static_cast<float>(least_m);
    });
    return static_cast<float>(least_m - needed_m);
  }
  float room_of(std::int32_t node) {
    float& room = grid_[node].room_m;
    if (std::isnan(room)) room = room_m(grid_.place(node));
    return room;
  }

  [[nodiscard]] bool is_clear(const Vector3d& from, const Vector3d& to) const {
    const Vector3d way = to - from;
    const double length_m = way.norm();
    for (double gone_m = 0.0; gone_m < length_m;) {
      const double room = static_cast<double>(room_m(from + gone_m / length_m * way));
      if (room < 0.0) return false;
      gone_m += std::max(room, 2.0 * kSlack_m);
    }
    return room_m(to) >= 0.0F;
  }

  void expand(std::int32_t node, std::int32_t goal) {
    for (int direction = 0; direction < 27; ++direction) {
      const Eigen::Vector3i step(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
      const std::int32_t next = grid_.beside(node, step);
      if (next < 0 || room_of(next) < 0.0F) continue;
      const auto length_m = static_cast<float>(kStep_m * step.cast<double>().norm());
      const float cost_m = grid_[node].cost_m + length_m;
      if (!(cost_m < grid_[next].cost_m)) continue;
      // What is not in the room of one is in that of the other.
      const bool is_open = room_of(node) + room_of(next) >= length_m;
      if (is_open || is_clear(grid_.place(node), grid_.place(next)))
        reach(next, node, cost_m, goal);
    }
  }

  void reach(std::int32_t node, std::int32_t from, float cost_m, std::int32_t goal) {
    grid_[node].cost_m = cost_m;
    grid_[node].from = from;
    const auto left_m = static_cast<float>((grid_.place(goal) - grid_.place(node)).norm());
    queue_.emplace(-(cost_m + left_m), node);
  }

  [[nodiscard]] std::vector<Vector3d> path_to(std::int32_t node) {
    std::vector<Vector3d> path;
    for (; node >= 0; node = grid_[node].from) path.push_back(grid_.place(node));
    std::ranges::reverse(path);
    return path;
  }

  /// Leaves out what need not be turned at.
  [[nodiscard]] std::vector<Vector3d> straightened(const std::vector<Vector3d>& path) const {
    std::vector<Vector3d> corners{path.front()};
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      if (!is_clear(corners.back(), path[i + 1])) corners.push_back(path[i]);
    }
    corners.push_back(path.back());
    return corners;
  }

  const RayCaster& world_;
  const WayLimits& limits_;
  WayGrid grid_;
  std::int32_t start_;
  std::priority_queue<std::pair<float, std::int32_t>> queue_;  // the most hopeful first
};

}  // namespace

std::optional<std::vector<Vector3d>> clear_way(const RayCaster& world, const Vector3d& start_m,
                                               const Vector3d& goal_m, const WayLimits& limits) {
  return WaySearch(world, start_m, limits).to(goal_m);
}

}  // namespace swiftlet::sim
