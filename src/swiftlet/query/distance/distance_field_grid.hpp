// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/map/block_window.hpp"

namespace swiftlet {

/// Where the voxels of a box of blocks lie in the arrays of a distance field.
///
/// Wrap-around, as in the map: a voxel has one place for as long as it is in the box, wherever the
/// box is, so a move of the box moves nothing. Arrays are slices of rows of vectors of 16 voxels
/// along x. Along x there is room for a block more than the box has, so that no vector holds both
/// ends of it; what lies in that room is outside. Beside places there are positions, counted from
/// the first row and slice of the box and the first vector that it touches: what is next to each
/// other in space is next to each other in positions.
class DistanceGrid {
 public:
  static constexpr int kLanes = 16;  ///< voxels in a vector

  /// Keeps tables of rows for `reach` rows beyond both ends of the box.
  /// REQUIRES: size positive along each axis; reach >= 0.
  DistanceGrid(const BlockIndex& size, int reach)
      : box_{{}, size},
        reach_(reach),
        vectors_((size.x + 2) / 2),
        row_at_(static_cast<std::size_t>(rows()) + 2 * static_cast<std::size_t>(reach)),
        slice_at_(static_cast<std::size_t>(slices())),
        vector_at_(static_cast<std::size_t>(vectors_)) {
    move_to({});
  }

  void move_to(const BlockIndex& first) {
    box_.first = first;
    const VoxelIndex v = first_voxel(first);
    phase_ = {floor_mod(v.x, vectors_ * kLanes), floor_mod(v.y, rows()), floor_mod(v.z, slices())};
    // The row beyond the last one stands for everything outside.
    for (int y = -reach_; y < rows() + reach_; ++y) {
      const bool is_inside = y >= 0 && y < rows();
      row_at_[size(y + reach_)] =
          (is_inside ? wrap(y + phase_.y, rows()) : rows()) * vectors_ * kLanes;
    }
    for (int z = 0; z < slices(); ++z) slice_at_[size(z)] = wrap(z + phase_.z, slices());
    for (int i = 0; i < vectors_; ++i) vector_at_[size(i)] = wrap(i + phase_.x / kLanes, vectors_);
  }

  [[nodiscard]] const BlockWindow& box() const { return box_; }
  [[nodiscard]] int rows() const { return box_.size.y * kBlockEdge; }
  [[nodiscard]] int slices() const { return box_.size.z * kBlockEdge; }
  /// Of one row of the arrays.
  [[nodiscard]] int vectors() const { return vectors_; }
  /// Of these, those that the box touches; the others hold only what is outside.
  [[nodiscard]] int box_vectors() const {
    return ((box_.end().x - 1) >> 1) - (box_.first.x >> 1) + 1;
  }

  /// Of an array with one row more a slice than the box has: it stands for what is outside.
  [[nodiscard]] std::size_t padded_slice() const { return row() * size(rows() + 1); }
  [[nodiscard]] std::size_t slice() const { return row() * size(rows()); }
  [[nodiscard]] std::size_t row() const { return size(vectors_ * kLanes); }

  /// Place of a row within a slice, in voxels; good for positions up to reach outside the box.
  [[nodiscard]] const std::int32_t* row_at() const { return row_at_.data() + reach_; }
  [[nodiscard]] const std::int32_t* slice_at() const { return slice_at_.data(); }
  [[nodiscard]] const std::int32_t* vector_at() const { return vector_at_.data(); }

  /// Position of the first voxel of a block along x; negative or too large outside the box.
  [[nodiscard]] int x_position(std::int32_t block_x) const {
    return (block_x - (box_.first.x >> 1) * 2) * kBlockEdge;
  }

  /// Where a voxel is in an array of whole slices. REQUIRES: the box contains it.
  struct Place {
    std::int32_t x, y, z;
  };
  [[nodiscard]] Place place_of(const VoxelIndex& v) const {
    const VoxelIndex first = first_voxel(box_.first);
    return {wrap(v.x - first.x + phase_.x, vectors_ * kLanes),
            wrap(v.y - first.y + phase_.y, rows()), wrap(v.z - first.z + phase_.z, slices())};
  }
  [[nodiscard]] std::size_t padded_index(const Place& p) const {
    return size(p.z) * padded_slice() + size(p.y) * row() + size(p.x);
  }
  [[nodiscard]] std::size_t index(const Place& p) const {
    return size(p.z) * slice() + size(p.y) * row() + size(p.x);
  }

  /// Blocks lie as voxels do. The two blocks of a vector are neighbours.
  [[nodiscard]] std::size_t block_places() const {
    return size(2 * vectors_) * size(box_.size.y) * size(box_.size.z);
  }
  [[nodiscard]] std::size_t block_place(const Place& p) const {
    return (size(p.z >> kBlockShift) * size(box_.size.y) + size(p.y >> kBlockShift)) *
               size(2 * vectors_) +
           size(p.x >> kBlockShift);
  }

 private:
  [[nodiscard]] static constexpr std::size_t size(std::int32_t v) {
    return static_cast<std::size_t>(v);
  }
  [[nodiscard]] static constexpr std::int32_t wrap(std::int32_t v, std::int32_t n) {
    return v < n ? v : v - n;
  }
  [[nodiscard]] static constexpr std::int32_t floor_mod(std::int32_t v, std::int32_t n) {
    const std::int32_t r = v % n;
    return r < 0 ? r + n : r;
  }

  BlockWindow box_;
  int reach_;
  int vectors_;
  VoxelIndex phase_{};  // the first voxel of the box modulo the arrays' extents
  std::vector<std::int32_t> row_at_, slice_at_, vector_at_;
};

}  // namespace swiftlet
