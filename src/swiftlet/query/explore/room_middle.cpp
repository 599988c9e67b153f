// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/explore/room_middle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "swiftlet/base/grid_ray.hpp"

namespace swiftlet {
namespace {

struct Place {
  int x = 0, y = 0;
};

/// A flat piece of the map, seen from above: how far each column of voxels is from the nearest one
/// that cannot be flown through. [voxels]
class Plan {
 public:
  Plan(const MapSnapshot& map, const VoxelBox& slab, const RoomOptions& options)
      : nx_(slab.last.x - slab.first.x + 1),
        ny_(slab.last.y - slab.first.y + 1),
        clearance_(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), 1.0) {
    mark_obstacles(map, slab, options);
    measure(options.unknown == UnknownSpace::kStops);
  }

  [[nodiscard]] bool contains(const Place& p) const {
    return p.x >= 0 && p.x < nx_ && p.y >= 0 && p.y < ny_;
  }
  [[nodiscard]] std::size_t at(const Place& p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(p.x);
  }
  [[nodiscard]] Place place(std::size_t i) const {
    const auto nx = static_cast<std::size_t>(nx_);
    return {static_cast<int>(i % nx), static_cast<int>(i / nx)};
  }
  [[nodiscard]] double clearance(std::size_t i) const { return clearance_[i]; }
  [[nodiscard]] std::size_t size() const { return clearance_.size(); }

 private:
  void mark_obstacles(const MapSnapshot& map, const VoxelBox& slab, const RoomOptions& options) {
    for (VoxelIndex v = slab.first; v.z <= slab.last.z; ++v.z) {
      for (v.y = slab.first.y; v.y <= slab.last.y; ++v.y) {
        for (v.x = slab.first.x; v.x <= slab.last.x; ++v.x) {
          const Occupancy state = options.thresholds.classify(map.log_odds(v));
          const bool stops =
              state == Occupancy::kOccupied ||
              (state == Occupancy::kUnknown && options.unknown == UnknownSpace::kStops);
          if (stops) clearance_[at({v.x - slab.first.x, v.y - slab.first.y})] = 0.0;
        }
      }
    }
  }

  /// Exact distances between centres: along y first, then the least sum of squares along x, sought
  /// no farther than the best so far.
  void measure(bool rim_stops) {
    const double far = nx_ + ny_ + 2.0;
    std::vector<double> along_y(clearance_.size());
    for (int x = 0; x < nx_; ++x) {
      double d = rim_stops ? 0.0 : far;
      for (int y = 0; y < ny_; ++y)
        along_y[at({x, y})] = d = clearance_[at({x, y})] == 0.0 ? 0.0 : std::min(d + 1.0, far);
      d = rim_stops ? 0.0 : far;
      for (int y = ny_ - 1; y >= 0; --y) {
        d = std::min(d + 1.0, along_y[at({x, y})]);
        along_y[at({x, y})] = d;
      }
    }
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x)
        clearance_[at({x, y})] = std::sqrt(least_square(along_y, {x, y}, rim_stops));
    }
  }
  [[nodiscard]] double least_square(const std::vector<double>& along_y, const Place& p,
                                    bool rim_stops) const {
    double least = along_y[at(p)] * along_y[at(p)];
    for (int k = 1; static_cast<double>(k) * k < least; ++k) {
      for (const int x : {p.x - k, p.x + k}) {
        const bool is_in = x >= 0 && x < nx_;
        if (!is_in && !rim_stops) continue;
        const double d = is_in ? along_y[at({x, p.y})] : 0.0;
        least = std::min(least, static_cast<double>(k) * k + d * d);
      }
      if (p.x - k < 0 && p.x + k >= nx_) break;
    }
    return least;
  }

  int nx_;
  int ny_;
  std::vector<double> clearance_;
};

/// All places that hang together with `from` and have more clearance than `least`, nearest first;
/// empty if `from` has not.
std::vector<std::size_t> reachable(const Plan& plan, std::size_t from, double least) {
  std::vector<std::size_t> found;
  if (!(plan.clearance(from) > least)) return found;
  std::vector<std::uint8_t> is_found(plan.size(), 0);
  found.push_back(from);
  is_found[from] = 1;
  for (std::size_t next = 0; next < found.size(); ++next) {
    const Place p = plan.place(found[next]);
    for (const Place& q :
         {Place{p.x - 1, p.y}, Place{p.x + 1, p.y}, Place{p.x, p.y - 1}, Place{p.x, p.y + 1}}) {
      if (!plan.contains(q) || is_found[plan.at(q)] != 0 || !(plan.clearance(plan.at(q)) > least))
        continue;
      is_found[plan.at(q)] = 1;
      found.push_back(plan.at(q));
    }
  }
  return found;
}

/// The room: what hangs together with the vehicle's place, or with the nearest place to it that is
/// wider than a door.
std::vector<std::size_t> room_around(const Plan& plan, std::size_t from, double half_door) {
  for (const std::size_t near : reachable(plan, from, 0.0)) {
    if (plan.clearance(near) > half_door) return reachable(plan, near, half_door);
  }
  return {};
}

struct Middle {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // [voxels], of centres
  double clearance = 0.0;
};

Middle middle_of(const Plan& plan, const std::vector<std::size_t>& room) {
  constexpr double kPlateau_voxels = 1.5;
  double most = 0.0;
  for (const std::size_t i : room) most = std::max(most, plan.clearance(i));
  const double least = most - kPlateau_voxels;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (const std::size_t i : room) {
    const double more = plan.clearance(i) - least;
    if (more < 0.0) continue;
    const Place p = plan.place(i);
    sum += more * Eigen::Vector2d(p.x, p.y);
    weight += more;
  }
  const Eigen::Vector2d mean = sum / weight;
  Middle nearest;
  double nearest_square = std::numeric_limits<double>::infinity();
  for (const std::size_t i : room) {
    const Place p = plan.place(i);
    const double square = (Eigen::Vector2d(p.x, p.y) - mean).squaredNorm();
    if (plan.clearance(i) < least || square >= nearest_square) continue;
    nearest = {Eigen::Vector2d(p.x, p.y), plan.clearance(i)};
    nearest_square = square;
  }
  // The mean itself, finer than a voxel, where the plateau is.
  const bool is_on_plateau = nearest_square <= 0.5;
  if (is_on_plateau) nearest.at = mean;
  return nearest;
}

}  // namespace

Expected<std::optional<RoomMiddle>> room_middle(const MapSnapshot& map,
                                                const Eigen::Vector3d& p_world,
                                                const RoomOptions& options) {
  const auto is_measure = [](double v) { return v >= 0.0 && v <= 1e6; };  // false for NaN
  if (!(p_world.array().abs() < 1e6).all() || !is_measure(options.half_height_m) ||
      !is_measure(options.door_m)) {
    return fail(ErrorCode::kUsage, "room", "the place or a size cannot be used",
                "give finite numbers, sizes not below 0, in metres");
  }
  const double voxel_m = map.voxel_m();
  const Eigen::Vector3d up(0.0, 0.0, options.half_height_m);
  const VoxelIndex here = voxel_containing(p_world, voxel_m);
  VoxelBox slab = voxel_box(map.window());
  if (!slab.contains(here)) return std::nullopt;
  slab.first.z = std::max(slab.first.z, voxel_containing(p_world - up, voxel_m).z);
  slab.last.z = std::min(slab.last.z, voxel_containing(p_world + up, voxel_m).z);
  const Plan plan(map, slab, options);
  const std::size_t from = plan.at({here.x - slab.first.x, here.y - slab.first.y});
  // Between centres: the obstacle's face is half a voxel nearer.
  const auto room = room_around(plan, from, 0.5 * options.door_m / voxel_m + 0.5);
  if (room.empty()) return std::nullopt;
  const Middle middle = middle_of(plan, room);
  const Eigen::Vector2d first(slab.first.x + 0.5, slab.first.y + 0.5);
  const Eigen::Vector2d at_m = voxel_m * (first + middle.at);
  // Between centres; the obstacle's voxel reaches half a diagonal farther, and the mean lies as far
  // from the centre that its clearance was measured at.
  const double clearance_m = voxel_m * std::max(0.0, middle.clearance - std::sqrt(2.0));
  return RoomMiddle{{at_m.x(), at_m.y(), p_world.z()},
                    clearance_m,
                    static_cast<double>(room.size()) * voxel_m * voxel_m};
}

}  // namespace swiftlet
