// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/ring/obstacle_ring.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "swiftlet/query/distance/block_bits.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr double kSector_rad = 2 * std::numbers::pi / static_cast<double>(kSectors);
/// Far above the rounding of angles, far below what matters: a voxel on the line between two
/// sectors counts in both.
constexpr double kSlack_sectors = 1e-9;

/// Rows of voxels, both ends included.
struct Layers {
  int first, last;
};

Layers layers_between(double low_m, double high_m, double voxel_m) {
  return {static_cast<int>(std::floor(low_m / voxel_m)),
          static_cast<int>(std::floor(high_m / voxel_m))};
}

/// Half the height of a cylinder that is tilted out of the vertical.
double half_height(const Eigen::Quaterniond& R_world_body, const RingOptions& options) {
  const double cos_tilt = std::min(std::abs((R_world_body * Eigen::Vector3d::UnitZ()).z()), 1.0);
  const double sin_tilt = std::sqrt(1 - cos_tilt * cos_tilt);
  return 0.5 * options.body_height_m * cos_tilt + options.body_radius_m * sin_tilt;
}

/// The voxels of a column of blocks, seen from above: which are in the way.
struct ColumnBits {
  std::uint64_t occupied = 0;
  std::uint64_t unknown = 0;
};

class Look {
 public:
  Look(const MapSnapshot& map, const Transform<World, Body>& T_world_body,
       const RingOptions& options)
      : map_(map), thresholds_(map.scale().thresholds), options_(options), voxel_m_(map.voxel_m()) {
    const Eigen::Vector3d p = T_world_body.translation();
    const Eigen::Vector3d nose = T_world_body.rotation() * Eigen::Vector3d::UnitX();
    x_m_ = p.x();
    y_m_ = p.y();
    heading_rad_ = std::atan2(nose.y(), nose.x());
    const double half_m = half_height(T_world_body.rotation(), options);
    known_ = layers_between(p.z() - half_m, p.z() + half_m, voxel_m_);
    way_ = layers_between(p.z() - half_m - options.margin_m, p.z() + half_m + options.margin_m,
                          voxel_m_);
  }

  [[nodiscard]] ObstacleRing around() {
    const auto first = [this](double at_m) {
      return static_cast<int>(std::floor((at_m - options_.max_m) / voxel_m_)) >> kBlockShift;
    };
    const auto last = [this](double at_m) {
      return static_cast<int>(std::floor((at_m + options_.max_m) / voxel_m_)) >> kBlockShift;
    };
    for (int y = first(y_m_); y <= last(y_m_); ++y) {
      for (int x = first(x_m_); x <= last(x_m_); ++x) book_column(x, y);
    }
    return ring_;
  }

 private:
  [[nodiscard]] ColumnBits column_bits(int block_x, int block_y) const {
    ColumnBits bits;
    for (int z = way_.first >> kBlockShift; z <= way_.last >> kBlockShift; ++z) {
      const VoxelBlock* const block = map_.find({block_x, block_y, z});
      const int floor = z * kBlockEdge;
      const int from = std::max(way_.first - floor, 0);
      const int to = std::min(way_.last - floor, kBlockEdge - 1);
      for (int layer = from; layer <= to; ++layer) {
        const bool must_be_known = floor + layer >= known_.first && floor + layer <= known_.last;
        add_layer(block, layer, must_be_known, bits);
      }
    }
    return bits;
  }

  void add_layer(const VoxelBlock* block, int layer, bool must_be_known, ColumnBits& bits) const {
    if (block == nullptr) {
      if (must_be_known) bits.unknown = ~std::uint64_t{0};
      return;
    }
    const std::uint64_t occupied = voxels_at_least(*block, layer, thresholds_.occupied_from);
    bits.occupied |= occupied;
    if (must_be_known)
      bits.unknown |= voxels_at_least(*block, layer, thresholds_.free_below) & ~occupied;
  }

  void book_column(int block_x, int block_y) {
    const ColumnBits bits = column_bits(block_x, block_y);
    for (std::uint64_t left = bits.occupied | bits.unknown; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const std::uint64_t mask = left & (~left + 1);
      book_voxel(block_x * kBlockEdge + bit % kBlockEdge, block_y * kBlockEdge + bit / kBlockEdge,
                 (bits.occupied & mask) != 0, (bits.unknown & mask) != 0);
    }
  }

  void book_voxel(int x, int y, bool is_occupied, bool is_unknown) {
    const Eigen::Vector2d low(x * voxel_m_ - x_m_, y * voxel_m_ - y_m_);
    const Eigen::Vector2d high(low.x() + voxel_m_, low.y() + voxel_m_);
    const double distance_m = low.cwiseMax(-high).cwiseMax(0).norm();
    if (distance_m > options_.max_m) return;
    is_unknown = is_unknown && (0.5 * (low + high)).norm() >= options_.blind_m;
    if (!is_occupied && !is_unknown) return;
    const auto [first, last] = sectors_of(low, high);
    for (int i = first; i <= last; ++i) {
      constexpr int kCount = static_cast<int>(kSectors);
      SectorView& view = ring_.sectors[static_cast<std::size_t>(((i % kCount) + kCount) % kCount)];
      if (is_occupied) view.occupied_m = std::min(view.occupied_m, distance_m);
      if (is_unknown) view.unknown_m = std::min(view.unknown_m, distance_m);
    }
  }

  /// The sectors that a square covers a part of, not yet brought into 0 to 71.
  [[nodiscard]] std::pair<int, int> sectors_of(const Eigen::Vector2d& low,
                                               const Eigen::Vector2d& high) const {
    if (low.maxCoeff() <= 0 && high.minCoeff() >= 0) return {0, static_cast<int>(kSectors) - 1};
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    // Seen from outside, a square covers less than half the horizon: "further left" is an order.
    Eigen::Vector2d right = low, left = low;
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(high.x(), low.y()), Eigen::Vector2d(low.x(), high.y()), high}) {
      if (cross(corner, right) > 0) right = corner;
      if (cross(left, corner) > 0) left = corner;
    }
    const double begin_rad = heading_rad_ - std::atan2(left.y(), left.x());  // clockwise
    const double span_rad = std::atan2(cross(right, left), right.dot(left));
    const double begin = begin_rad / kSector_rad + 0.5;
    return {static_cast<int>(std::floor(begin - kSlack_sectors)),
            static_cast<int>(std::floor(begin + span_rad / kSector_rad + kSlack_sectors))};
  }

  const MapSnapshot& map_;
  OccupancyThresholds thresholds_;
  const RingOptions& options_;
  double voxel_m_;
  double x_m_ = 0, y_m_ = 0, heading_rad_ = 0;
  Layers known_{}, way_{};
  ObstacleRing ring_;
};

}  // namespace

ObstacleRing look_around(const MapSnapshot& map, const Transform<World, Body>& T_world_body,
                         const RingOptions& options) {
  return Look(map, T_world_body, options).around();
}

}  // namespace swiftlet::mavlink
