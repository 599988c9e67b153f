// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/map/log_odds.hpp"

namespace swiftlet::eval {

/// A value for each voxel of a box, x fastest, then y, then z.
template <class T>
class DenseGrid {
 public:
  DenseGrid() = default;
  /// REQUIRES: box.first <= box.last along each axis.
  DenseGrid(const VoxelBox& box, T fill)
      : box_(box),
        nx_(extent(box.first.x, box.last.x)),
        ny_(extent(box.first.y, box.last.y)),
        voxels_(nx_ * ny_ * extent(box.first.z, box.last.z), fill) {}

  [[nodiscard]] const VoxelBox& box() const { return box_; }
  [[nodiscard]] std::size_t size() const { return voxels_.size(); }
  [[nodiscard]] bool contains(const VoxelIndex& v) const {
    return !voxels_.empty() && box_.contains(v);
  }

  /// REQUIRES: contains(v) (not checked: hot).
  [[nodiscard]] T& at(const VoxelIndex& v) { return voxels_[place_of(v)]; }
  [[nodiscard]] const T& at(const VoxelIndex& v) const { return voxels_[place_of(v)]; }
  [[nodiscard]] T at_or(const VoxelIndex& v, T outside) const {
    return contains(v) ? at(v) : outside;
  }

  [[nodiscard]] std::span<T> voxels() { return voxels_; }
  [[nodiscard]] std::span<const T> voxels() const { return voxels_; }

  /// The voxel at a place of voxels(). REQUIRES: place < size().
  [[nodiscard]] VoxelIndex voxel(std::size_t place) const {
    const auto at = [](std::int32_t first, std::size_t offset) {
      return first + static_cast<std::int32_t>(offset);
    };
    const std::size_t row = place / nx_;
    return {at(box_.first.x, place % nx_), at(box_.first.y, row % ny_),
            at(box_.first.z, row / ny_)};
  }
  /// Calls visit(VoxelIndex, T) for every voxel.
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::size_t place = 0;
    for (std::int32_t z = box_.first.z; z <= box_.last.z && place < voxels_.size(); ++z) {
      for (std::int32_t y = box_.first.y; y <= box_.last.y; ++y) {
        for (std::int32_t x = box_.first.x; x <= box_.last.x; ++x)
          visit(VoxelIndex{x, y, z}, voxels_[place++]);
      }
    }
  }

 private:
  static std::size_t extent(std::int32_t first, std::int32_t last) {
    return static_cast<std::size_t>(last - first) + 1;
  }
  [[nodiscard]] std::size_t place_of(const VoxelIndex& v) const {
    const auto x = static_cast<std::size_t>(v.x - box_.first.x);
    const auto y = static_cast<std::size_t>(v.y - box_.first.y);
    const auto z = static_cast<std::size_t>(v.z - box_.first.z);
    return (z * ny_ + y) * nx_ + x;
  }

  VoxelBox box_{};
  std::size_t nx_ = 0;
  std::size_t ny_ = 0;
  std::vector<T> voxels_;
};

/// What a map claims of each voxel of a box: the form in which any mapper's result is judged.
using Claims = DenseGrid<Occupancy>;

/// Whether is(neighbour) holds for any voxel within `reach` voxels along each axis, itself
/// included.
template <class Is>
[[nodiscard]] bool any_within(const VoxelIndex& v, std::int32_t reach, Is&& is) {
  for (std::int32_t z = v.z - reach; z <= v.z + reach; ++z) {
    for (std::int32_t y = v.y - reach; y <= v.y + reach; ++y) {
      for (std::int32_t x = v.x - reach; x <= v.x + reach; ++x) {
        if (is(VoxelIndex{x, y, z})) return true;
      }
    }
  }
  return false;
}

[[nodiscard]] inline bool is_occupied_within(const Claims& claims, const VoxelIndex& v,
                                             std::int32_t reach) {
  return any_within(v, reach, [&](const VoxelIndex& n) {
    return claims.at_or(n, Occupancy::kUnknown) == Occupancy::kOccupied;
  });
}

}  // namespace swiftlet::eval
