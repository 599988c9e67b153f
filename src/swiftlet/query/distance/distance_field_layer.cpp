// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/distance/distance_field_layer.hpp"

#include <algorithm>

namespace swiftlet {
namespace {

using Index = DistanceArrays::Index;
constexpr Index kVectorVoxels = DistanceGrid::kLanes;

std::size_t size_of(std::int64_t v) { return static_cast<std::size_t>(v); }

/// By square below cap: how far away a voxel may be for which it is less than cap still.
std::vector<std::uint8_t> reaches_from(int cap) {
  std::vector<std::uint8_t> reach(size_of(cap) + 1);
  for (int v = 0; v < cap; ++v) {
    reach[size_of(v)] = static_cast<std::uint8_t>(distance_reach(cap - v) - 1);
  }
  return reach;
}

/// Blocks along one axis that are in `from` and not in `of`, in order; the boxes overlap.
struct BlockRange {
  std::int32_t first, end;
};
BlockRange blocks_outside(const BlockWindow& from, const BlockWindow& of,
                          std::int32_t BlockIndex::*axis) {
  const std::int32_t begin = from.first.*axis, end = from.end().*axis;
  if (of.first.*axis > begin) return {begin, of.first.*axis};
  return {of.end().*axis, std::max(end, of.end().*axis)};
}

/// The least of those lanes that differ from what is outside, and of that; `cap` if none does.
template <class Lane>
int least_that_leaves(const Lane* lanes, Index count, Lane outside, int cap) {
  int least = cap;
  for (Index i = 0; i < count; ++i) {
    const int v = std::min<int>(lanes[i], outside);
    if (lanes[i] != outside) least = std::min(least, v);
  }
  return least;
}

}  // namespace

int distance_reach(int cap) {
  int reach = 0;
  while (reach * reach < cap) ++reach;
  return reach;
}

DistanceLayer::DistanceLayer(const DistanceGrid& grid, int cap, const DistanceTarget& target)
    : target_(target),
      cap_(static_cast<std::uint16_t>(cap)),
      reach_(distance_reach(cap)),
      row_words_((grid.rows() + 63) / 64),
      line_words_((grid.vectors() + 63) / 64),
      outside_along_z_(target.is_outside_obstacle ? 0 : static_cast<std::uint8_t>(reach_)),
      outside_(target.is_outside_obstacle ? 0 : cap_),
      reach_from_(reaches_from(cap)),
      along_z_(grid.padded_slice() * size_of(grid.slices())),
      within_slice_(grid.slice() * size_of(grid.slices())),
      everywhere_(within_slice_.size()),
      columns_(size_of(grid.vectors()) * size_of(row_words_)),
      rows_todo_(columns_.size() * size_of(grid.slices())),
      lines_todo_(size_of(grid.slices()) * size_of(grid.rows()) * size_of(line_words_)),
      has_lines_(size_of(grid.slices())) {
  clear(grid);
}

void DistanceLayer::clear(const DistanceGrid& grid) {
  std::ranges::fill(along_z_, outside_along_z_);  // the row that stands for outside, too
  std::ranges::fill(within_slice_, outside_);
  std::ranges::fill(columns_, 0U);
  std::ranges::fill(rows_todo_, 0U);
  std::ranges::fill(lines_todo_, 0U);
  redo_columns(grid);
  for (int z = 0; z < grid.slices(); ++z) redo_slice(grid, z);
}

void DistanceLayer::redo_columns(const DistanceGrid& grid) {
  for (int v = 0; v < grid.box_vectors(); ++v)
    TodoBits::set(&columns_[size_of(v) * size_of(row_words_)], 0, grid.rows() - 1);
}

void DistanceLayer::redo_slice(const DistanceGrid& grid, int z) {
  const DistanceArrays a = arrays(grid, nullptr);
  for (Index v = 0; v < a.box_vectors; ++v) a.mark_rows(z, v, 0, a.rows - 1);
  for (Index y = 0; y < a.rows; ++y) a.mark_line(z, y, 0, a.box_vectors * kVectorVoxels - 1);
}

void DistanceLayer::move(const BlockWindow& before, const DistanceGrid& now) {
  if (before.first.x != now.box().first.x) move_along_x(before, now);
  if (before.first.y != now.box().first.y) move_along_y(before, now);
  if (before.first.z != now.box().first.z) move_along_z(before, now);
}

// What leaves along x becomes as outside, in the room that was kept for that; the voxels that it
// was nearest to are worked out again, and those that enter.
void DistanceLayer::move_along_x(const BlockWindow& before, const DistanceGrid& now) {
  const DistanceArrays a = arrays(now, nullptr);
  const BlockRange leaving = blocks_outside(before, now.box(), &BlockIndex::x);
  const BlockRange entering = blocks_outside(now.box(), before, &BlockIndex::x);
  const int enters_at = now.x_position(entering.first), enters_until = now.x_position(entering.end);
  for (Index z = 0; z < a.slices; ++z) {
    for (Index y = 0; y < a.rows; ++y) {
      for (std::int32_t b = leaving.first; b < leaving.end; ++b) leave_along_x(a, b, now, z, y);
      a.mark_line(z, y, enters_at, enters_until - 1);
    }
  }
}

void DistanceLayer::leave_along_x(const DistanceArrays& a, std::int32_t block_x,
                                  const DistanceGrid& now, Index z, Index y) {
  const Index blocks = 2 * a.vectors;
  const Index row = a.row_at[y] + (block_x % blocks + blocks) % blocks * kBlockEdge;
  std::uint16_t* const lanes = &within_slice_[size_of(a.slice_at[z] * a.slice + row)];
  const int least = least_that_leaves(lanes, kBlockEdge, outside_, cap_);
  if (least < cap_) {
    const int x = now.x_position(block_x), span = reach_from_[size_of(least)];
    a.mark_line(z, y, x - span, x + kBlockEdge - 1 + span);
    std::fill_n(lanes, kBlockEdge, outside_);
  }
  std::fill_n(&along_z_[size_of(a.slice_at[z] * a.padded_slice + row)], kBlockEdge,
              outside_along_z_);
}

// Rows that enter take the place of those that leave.
void DistanceLayer::move_along_y(const BlockWindow& before, const DistanceGrid& now) {
  const DistanceArrays a = arrays(now, nullptr);
  const BlockRange leaving = blocks_outside(before, now.box(), &BlockIndex::y);
  const BlockRange entering = blocks_outside(now.box(), before, &BlockIndex::y);
  const auto position = [&](std::int32_t b) { return Index{b - now.box().first.y} * kBlockEdge; };
  for (Index y = position(entering.first); y < position(entering.end); ++y) {
    const Index left_at = y - position(entering.first) + position(leaving.first);
    for (Index z = 0; z < a.slices; ++z) {
      std::uint8_t* const row = &along_z_[size_of(a.slice_at[z] * a.padded_slice + a.row_at[y])];
      for (Index v = 0; v < a.box_vectors; ++v) {
        const int least = least_that_leaves(row + a.vector_at[v] * kVectorVoxels, kVectorVoxels,
                                            outside_along_z_, reach_);
        if (least < reach_)
          a.mark_rows(z, v, left_at, reach_from_[size_of(std::min<int>(least * least, cap_))]);
        a.mark_rows(z, v, y, 0);
      }
      std::fill_n(row, a.row, outside_along_z_);
      a.mark_line(z, y, 0, a.box_vectors * kVectorVoxels - 1);
    }
    for (int v = 0; v < a.box_vectors; ++v) touch(v, static_cast<int>(y));
  }
}

// Every column has other ends. Slices that enter take the place of those that leave, and slices
// know nothing of each other but by columns.
void DistanceLayer::move_along_z(const BlockWindow& before, const DistanceGrid& now) {
  redo_columns(now);
  const BlockRange entering = blocks_outside(now.box(), before, &BlockIndex::z);
  for (std::int32_t z = entering.first * kBlockEdge; z < entering.end * kBlockEdge; ++z)
    redo_slice(now, z - now.box().first.z * kBlockEdge);
}

void DistanceLayer::update(const DistanceGrid& grid, const std::vector<ObstacleBits>& bits,
                           WorkerTeam& team, std::vector<DistanceScratch>& scratch) {
  const DistanceArrays a = arrays(grid, bits.data());
  const int threads = team.threads();
  // Columns of different vectors mark different words, and slices know nothing of each other.
  team.run([&](int worker) {
    for (Index v = worker; v < a.box_vectors; v += threads)
      pass_columns(a, v, scratch[size_of(worker)].column.data());
  });
  team.run([&](int worker) {
    for (Index z = worker; z < a.slices; z += threads)
      pass_slice(a, z, scratch[size_of(worker)].line.data());
  });
}

DistanceArrays DistanceLayer::arrays(const DistanceGrid& grid, const ObstacleBits* bits) {
  return {.vectors = grid.vectors(),
          .box_vectors = grid.box_vectors(),
          .rows = grid.rows(),
          .slices = grid.slices(),
          .row = static_cast<Index>(grid.row()),
          .slice = static_cast<Index>(grid.slice()),
          .padded_slice = static_cast<Index>(grid.padded_slice()),
          .row_at = grid.row_at(),
          .slice_at = grid.slice_at(),
          .vector_at = grid.vector_at(),
          .reach = reach_,
          .cap = cap_,
          .reach_from = reach_from_.data(),
          .is_outside_obstacle = target_.is_outside_obstacle,
          .flip = static_cast<std::uint16_t>(target_.is_flipped ? 0xffff : 0),
          .bits = bits,
          .along_z = along_z_.data(),
          .within_slice = within_slice_.data(),
          .everywhere = everywhere_.data(),
          .columns = columns_.data(),
          .rows_todo = rows_todo_.data(),
          .lines_todo = lines_todo_.data(),
          .has_lines = has_lines_.data(),
          .row_words = row_words_,
          .line_words = line_words_};
}

std::size_t DistanceLayer::memory_bytes() const {
  const std::size_t words = columns_.size() + rows_todo_.size() + lines_todo_.size();
  return along_z_.size() + 2 * (within_slice_.size() + everywhere_.size()) + 8 * words +
         reach_from_.size() + has_lines_.size();
}

}  // namespace swiftlet
