// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "swiftlet/integrate/cube_view.hpp"
#include "swiftlet/integrate/reading_sums.hpp"

namespace swiftlet {

/// The exact image of one cell: which rays cross it, row by row.
///
/// A ray z D meets face i of the near side at z = near_i / |D_i| and leaves through face j of the
/// far side at z = far_j / |D_j|; it crosses the cube if every entry comes before every exit. Each
/// of these conditions, near_i |D_j| <= far_j |D_i|, is a half-plane of the image because D is
/// linear in the pixel: at most six, the sides of the hexagon that a cube looks like.
class Silhouette {
 public:
  /// REQUIRES: the cell lies in front of the camera and does not hold it.
  Silhouette(const CubeView& view, const CubeInView& cell);

  /// Pixels [first, last] of a row whose rays cross the cell; empty if first > last.
  struct Run {
    int first, last;
  };
  /// The run of row v within [u0, u1].
  [[nodiscard]] Run run(int v, float u0, float u1) const;

  /// The part of a query that describes rays: where they enter the cell.
  void describe(const CubeView& view, ReadingQuery& query) const;

 private:
  void add_side(float entry, const Float3& entry_normal, float exit, const Float3& exit_normal);

  struct Side {
    float u_per_v, u_offset;  // u on the edge at row v
  };
  // Edges that bound a run from the left and from the right; the others are level.
  std::array<Side, 6> left_, right_;
  int lefts_ = 0, rights_ = 0;
  // Level edges and empty images: rows outside are not crossed at all.
  float v_low_ = -1e9F, v_high_ = 1e9F;
  Float3 near_, sign_;  // sign_ is 0 for a pair of faces around the camera: no ray enters there
};

inline Silhouette::Run Silhouette::run(int v, float u0, float u1) const {
  const auto row = static_cast<float>(v);
  if (row < v_low_ || row > v_high_) return {0, -1};
  for (int i = 0; i < lefts_; ++i) {
    const Side& side = left_[static_cast<std::size_t>(i)];
    u0 = std::max(u0, side.u_per_v * row + side.u_offset);
  }
  for (int i = 0; i < rights_; ++i) {
    const Side& side = right_[static_cast<std::size_t>(i)];
    u1 = std::min(u1, side.u_per_v * row + side.u_offset);
  }
  if (u0 > u1) return {0, -1};
  return {static_cast<int>(std::ceil(u0)), static_cast<int>(std::floor(u1))};
}

}  // namespace swiftlet
