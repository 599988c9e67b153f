// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "swiftlet/query/distance/distance_field.hpp"

namespace swiftlet::test {

/// The distance field by looking: every voxel nearer first, from the one asked for. Slow and plain.
class BruteDistance {
 public:
  explicit BruteDistance(double reach_voxels) : edge_(static_cast<int>(reach_voxels + 1e-6) + 1) {
    const int most = static_cast<int>(reach_voxels * reach_voxels + 1e-6);
    for (int z = -edge_; z <= edge_; ++z)
      for (int y = -edge_; y <= edge_; ++y)
        for (int x = -edge_; x <= edge_; ++x)
          if (x * x + y * y + z * z <= most) steps_.push_back({x * x + y * y + z * z, x, y, z, 0});
    std::ranges::stable_sort(steps_, {}, &Step::squared);
  }

  /// Takes in what a snapshot says of a box; what is outside of it is unknown.
  void look(const MapSnapshot& map, const BlockWindow& box, const OccupancyThresholds& thresholds) {
    box_ = voxel_box(box);
    nx_ = box.size.x * kBlockEdge + 2 * edge_;
    ny_ = box.size.y * kBlockEdge + 2 * edge_;
    const int nz = box.size.z * kBlockEdge + 2 * edge_;
    const Occupancy unknown = thresholds.classify(kUnknownVoxel);
    classes_.assign(static_cast<std::size_t>(nx_) * ny_ * nz, unknown);
    for_each_block(box, [&](const BlockIndex& b) {
      const VoxelBlock* block = map.find(b);
      if (block == nullptr) return;
      for (int i = 0; i < kBlockVoxels; ++i)
        classes_[place(voxel_at(b, i))] = thresholds.classify(block->voxels[i]);
    });
    for (Step& s : steps_) s.offset = (static_cast<std::ptrdiff_t>(s.z) * ny_ + s.y) * nx_ + s.x;
  }

  [[nodiscard]] Occupancy class_of(const VoxelIndex& v) const { return classes_[place(v)]; }
  [[nodiscard]] bool is_obstacle(const VoxelIndex& v, Obstacles obstacles) const {
    return is_obstacle(classes_[place(v)], obstacles);
  }

  /// Squared [voxels²]; nullopt beyond reach. `of_free`: to the nearest voxel that is no obstacle.
  [[nodiscard]] std::optional<int> squared(const VoxelIndex& v, Obstacles obstacles,
                                           bool of_free = false) const {
    const Occupancy* here = classes_.data() + place(v);
    for (const Step& s : steps_)
      if (is_obstacle(here[s.offset], obstacles) != of_free) return s.squared;
    return std::nullopt;
  }

 private:
  struct Step {
    int squared, x, y, z;
    std::ptrdiff_t offset;
  };
  static bool is_obstacle(Occupancy state, Obstacles obstacles) {
    return state == Occupancy::kOccupied ||
           (obstacles == Obstacles::kNotFree && state != Occupancy::kFree);
  }
  [[nodiscard]] std::size_t place(const VoxelIndex& v) const {
    const auto x = static_cast<std::size_t>(v.x - box_.first.x + edge_);
    const auto y = static_cast<std::size_t>(v.y - box_.first.y + edge_);
    const auto z = static_cast<std::size_t>(v.z - box_.first.z + edge_);
    return (z * ny_ + y) * nx_ + x;
  }

  int edge_;
  std::vector<Step> steps_;
  VoxelBox box_{};
  int nx_ = 0, ny_ = 0;
  std::vector<Occupancy> classes_;
};

inline constexpr Obstacles kBothObstacles[] = {Obstacles::kOccupied, Obstacles::kNotFree};

/// Whether two fields answer alike for every voxel: the same bits, distance and status.
[[nodiscard]] inline bool same_bits(const DistanceField& a, const DistanceField& b) {
  if (!(a.box() == b.box())) return false;
  bool is_same = true;
  const auto compare = [&](const VoxelIndex& v, Obstacles obstacles) {
    const DistanceAnswer of_a = a.distance(v, obstacles), of_b = b.distance(v, obstacles);
    is_same = is_same && of_a.distance_m == of_b.distance_m && of_a.status == of_b.status &&
              a.squared_voxels(v, obstacles) == b.squared_voxels(v, obstacles);
  };
  for_each_block(a.box(), [&](const BlockIndex& block) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (a.options().occupied) compare(voxel_at(block, i), Obstacles::kOccupied);
      if (a.options().not_free) compare(voxel_at(block, i), Obstacles::kNotFree);
    }
  });
  return is_same;
}

}  // namespace swiftlet::test
