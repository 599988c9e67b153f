// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "swiftlet/render/projection.hpp"

namespace swiftlet::render {

inline constexpr Colour kPaper{255, 255, 255};
inline constexpr Colour kUnseen{205, 208, 212};      ///< seen from above: columns never looked into
inline constexpr Colour kFreeGround{250, 248, 240};  ///< and those without an occupied voxel

/// A picture of the world from above, one square per column of voxels: x forward is up, y left is
/// left. Around it a margin with a tick every metre (longer every five; in large maps every 2, 5,
/// 10 .. metres) and in the lower left corner a bar from one tick to the next; a cross marks where
/// the flight began, if the map tells it.
class FloorPlan {
 public:
  FloorPlan(const BlockMap& map, const VoxelBox& box, int voxel_px);

  /// Colours the square of column (x, y). REQUIRES: the column lies in the box.
  void fill_column(std::int32_t x, std::int32_t y, Colour colour);

  /// Draws the path, ticks, scale bar and start over the voxels and hands the picture out.
  [[nodiscard]] Picture finish(const ProjectionOptions& options) &&;

 private:
  [[nodiscard]] int column_px(double y_m) const;  // pixel column of a world y
  [[nodiscard]] int row_px(double x_m) const;     // pixel row of a world x
  void draw_ticks();
  void draw_scale_bar();
  void draw_start();
  void draw_path(std::span<const Eigen::Vector3d> path);

  VoxelBox box_;
  double voxel_m_;
  std::optional<Eigen::Vector3d> start_m_;
  int voxel_px_;
  double tick_m_;  // between two ticks
  Picture picture_;
};

/// What a column of voxels holds, within a box.
struct Column {
  int occupied = 0;
  int free = 0;
  std::int32_t highest = 0;  ///< z of the highest occupied voxel; 0 if there is none
};

/// The columns of a box, counted in one pass over the blocks: most of a large box may be empty.
class Columns {
 public:
  Columns(const BlockMap& map, const VoxelBox& box);
  [[nodiscard]] Column at(std::int32_t x, std::int32_t y) const;

 private:
  static constexpr std::size_t kOfBlock = kBlockEdge * kBlockEdge;
  std::unordered_map<BlockIndex, std::array<Column, kOfBlock>, BlockHash> by_block_;  // z = 0
};

/// The layer of voxels at a coordinate, whatever the number is; 0 for NaN.
[[nodiscard]] std::int32_t layer_at(double m, double voxel_m);

/// z of the lowest occupied voxel in a box: the foot of the scale of heights.
[[nodiscard]] std::optional<std::int32_t> lowest_matter(const BlockMap& map, const VoxelBox& box);

/// The box without what lies above options.z_m.
[[nodiscard]] VoxelBox cut_box(const VoxelBox& box, double voxel_m,
                               const ProjectionOptions& options);

/// Calls visit(x, y) for every column of a box.
template <class Visit>
void for_each_column(const VoxelBox& box, Visit&& visit) {
  for (std::int32_t x = box.first.x; x <= box.last.x; ++x) {
    for (std::int32_t y = box.first.y; y <= box.last.y; ++y) visit(x, y);
  }
}

}  // namespace swiftlet::render
