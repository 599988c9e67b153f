// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The questions to a distance field; distance_field.cpp keeps it up to date.

#include <cmath>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/query/distance/distance_field.hpp"

namespace swiftlet {
namespace {

bool has_bit(const ObstacleBits& bits, std::uint16_t offset) {
  return ((bits.rows[offset / 8U] >> (offset % 8U)) & 1U) != 0;
}

std::uint16_t offset_of(const DistanceGrid::Place& p) { return offset_in_block({p.x, p.y, p.z}); }

/// What lies between two neighbours along one axis.
struct Between {
  std::int32_t low, high;  // voxels
  double t;                // from low to high
};

/// The centres on both sides of a place, in the unit of voxels; both the one on the rim beyond it.
Between between(double place, std::int32_t first, std::int32_t last) {
  const double from_centre = place - 0.5;
  const double below = std::floor(from_centre);
  const auto low = static_cast<std::int32_t>(below);
  return {std::max(low, first), std::min(low + 1, last), from_centre - below};
}

/// 0, -1, 1, -2, 2 ...: visits until told that it is the one.
template <class IsIt>
std::optional<int> nearest_step(int reach, IsIt&& is_it) {
  for (int k = 0; k <= reach; ++k) {
    if (is_it(-k)) return -k;
    if (is_it(k)) return k;
  }
  return std::nullopt;
}

}  // namespace

const DistanceField::Kind& DistanceField::kind(Obstacles obstacles) const {
  const Kind& kind = kinds_[static_cast<std::size_t>(obstacles)];
  SWIFTLET_REQUIRE(kind.layer, "a distance field answers for the obstacles of its options");
  return kind;
}

double DistanceField::value_m(const Kind& kind, std::size_t index) const {
  const std::uint16_t squared = kind.layer->squared(index);
  if (squared != 0 || !kind.inside) return metres_[squared];
  return voxel_m_ - metres_[kind.inside->squared(index)];
}

DistanceStatus DistanceField::status_at(const Kind& kind, const DistanceGrid::Place& place) const {
  const std::size_t block = grid_.block_place(place);
  const std::uint16_t offset = offset_of(place);
  const bool is_unknown =
      has_bit(kinds_[1].bits[block], offset) && !has_bit(kinds_[0].bits[block], offset);
  if (is_unknown) return DistanceStatus::kUnknownHere;
  return kind.layer->squared(grid_.index(place)) < cap_ ? DistanceStatus::kKnown
                                                        : DistanceStatus::kBeyondReach;
}

DistanceAnswer DistanceField::distance(const VoxelIndex& voxel, Obstacles obstacles) const {
  const Kind& kind = this->kind(obstacles);
  if (!contains(voxel)) return {0.0, DistanceStatus::kOutside};
  const DistanceGrid::Place place = grid_.place_of(voxel);
  return {value_m(kind, grid_.index(place)), status_at(kind, place)};
}

std::optional<int> DistanceField::squared_voxels(const VoxelIndex& voxel,
                                                 Obstacles obstacles) const {
  const Kind& kind = this->kind(obstacles);
  SWIFTLET_REQUIRE(contains(voxel), "a distance field knows the voxels of its box");
  const std::uint16_t squared = kind.layer->squared(grid_.index(grid_.place_of(voxel)));
  return squared < cap_ ? std::optional<int>(squared) : std::nullopt;
}

DistanceSample DistanceField::sample(const Eigen::Vector3d& p_world, Obstacles obstacles) const {
  const Kind& kind = this->kind(obstacles);
  const VoxelBox inner = voxel_box(box());
  const Eigen::Vector3d p = p_world / voxel_m_;
  // A place that is no number, or too far for an index, compares as outside, too.
  const auto is_within = [](double v, std::int32_t first, std::int32_t last) {
    return v >= first && v < last + 1.0;
  };
  if (!has_map_ || !is_within(p.x(), inner.first.x, inner.last.x) ||
      !is_within(p.y(), inner.first.y, inner.last.y) ||
      !is_within(p.z(), inner.first.z, inner.last.z))
    return {0.0, Eigen::Vector3d::Zero(), DistanceStatus::kOutside};

  const Between x = between(p.x(), inner.first.x, inner.last.x);
  const Between y = between(p.y(), inner.first.y, inner.last.y);
  const Between z = between(p.z(), inner.first.z, inner.last.z);
  const DistanceGrid::Place low = grid_.place_of({x.low, y.low, z.low});
  const DistanceGrid::Place high = grid_.place_of({x.high, y.high, z.high});
  const auto at = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return value_m(kind, grid_.index({i, j, k}));
  };
  const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
  // Along x, then y, then z; the differences on the way are the gradient.
  struct Along {
    double value, dx;
  };
  const auto along_x = [&](std::int32_t j, std::int32_t k) {
    const double a = at(low.x, j, k), b = at(high.x, j, k);
    return Along{mix(a, b, x.t), b - a};
  };
  const Along c00 = along_x(low.y, low.z), c10 = along_x(high.y, low.z);
  const Along c01 = along_x(low.y, high.z), c11 = along_x(high.y, high.z);
  const double near = mix(c00.value, c10.value, y.t), far = mix(c01.value, c11.value, y.t);
  const Eigen::Vector3d slope(mix(mix(c00.dx, c10.dx, y.t), mix(c01.dx, c11.dx, y.t), z.t),
                              mix(c10.value - c00.value, c11.value - c01.value, z.t), far - near);
  const VoxelIndex here{static_cast<std::int32_t>(std::floor(p.x())),
                        static_cast<std::int32_t>(std::floor(p.y())),
                        static_cast<std::int32_t>(std::floor(p.z()))};
  return {mix(near, far, z.t), slope / voxel_m_, status_at(kind, grid_.place_of(here))};
}

bool DistanceField::is_obstacle(const Kind& kind, const VoxelIndex& voxel) const {
  if (!contains(voxel)) return kind.layer->target().is_outside_obstacle;
  const DistanceGrid::Place place = grid_.place_of(voxel);
  return has_bit(kind.bits[grid_.block_place(place)], offset_of(place));
}

// The passes backwards: which vector of the line, which row of the slice, which end of the column
// the least value came from.
std::optional<VoxelIndex> DistanceField::closest_obstacle(const VoxelIndex& voxel,
                                                          Obstacles obstacles) const {
  const Kind& kind = this->kind(obstacles);
  if (!contains(voxel)) return std::nullopt;
  const DistanceLayer& layer = *kind.layer;
  const int squared = layer.squared(grid_.index(grid_.place_of(voxel)));
  if (squared >= cap_) return std::nullopt;
  const int outside = layer.target().is_outside_obstacle ? 0 : cap_;
  VoxelIndex nearest = voxel;
  const auto dx = nearest_step(layer.reach(), [&](int k) {
    const VoxelIndex v{voxel.x + k, voxel.y, voxel.z};
    const int rest = contains(v) ? layer.within_slice(grid_.index(grid_.place_of(v))) : outside;
    return rest + k * k == squared;
  });
  SWIFTLET_REQUIRE(dx, "a distance comes from an obstacle");
  nearest.x += *dx;
  if (!contains(nearest)) return nearest;
  const int in_slice = squared - *dx * *dx;
  const auto dy = nearest_step(layer.reach(), [&](int k) {
    const VoxelIndex v{nearest.x, voxel.y + k, voxel.z};
    const int z = contains(v)    ? layer.along_z(grid_.padded_index(grid_.place_of(v)))
                  : outside == 0 ? 0
                                 : layer.reach();
    return z * z + k * k == in_slice;
  });
  SWIFTLET_REQUIRE(dy, "a distance comes from an obstacle");
  nearest.y += *dy;
  if (!contains(nearest)) return nearest;
  const auto dz = nearest_step(layer.reach(), [&](int k) {
    return k * k == in_slice - *dy * *dy && is_obstacle(kind, {nearest.x, nearest.y, voxel.z + k});
  });
  SWIFTLET_REQUIRE(dz, "a distance comes from an obstacle");
  nearest.z += *dz;
  return nearest;
}

}  // namespace swiftlet
