// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/render/floor_plan.hpp"

#include <algorithm>
#include <cmath>

#include "swiftlet/query/known_voxels.hpp"

namespace swiftlet::render {
namespace {

constexpr int kMargin_px = 28;
constexpr int kTick_px = 6;
constexpr int kLongTick_px = 12;
constexpr Colour kInk{70, 70, 70};
constexpr Colour kStartInk{214, 39, 40};
constexpr Colour kPathInk{227, 26, 175};
constexpr double kLeastTick_px = 4.0;  // between two ticks

/// 1 m, or the first of 2, 5, 10, 20 .. that keeps ticks apart, however large the voxels.
double metres_between_ticks(double px_per_m) {
  double step_m = 1.0;
  for (int i = 0; step_m * px_per_m < kLeastTick_px && std::isfinite(step_m); ++i)
    step_m *= i % 3 == 1 ? 2.5 : 2.0;
  return step_m;
}

/// Far outside any picture is outside.
int whole_px(double px) { return static_cast<int>(std::lround(std::clamp(px, -1e6, 1e6))); }

}  // namespace

FloorPlan::FloorPlan(const BlockMap& map, const VoxelBox& box, int voxel_px)
    : box_(box),
      voxel_m_(map.voxel_m()),
      start_m_(map.header().start_m),
      voxel_px_(voxel_px),
      tick_m_(metres_between_ticks(voxel_px / map.voxel_m())),
      picture_((box.last.y - box.first.y + 1) * voxel_px + 2 * kMargin_px,
               (box.last.x - box.first.x + 1) * voxel_px + 2 * kMargin_px, kPaper) {}

void FloorPlan::fill_column(std::int32_t x, std::int32_t y, Colour colour) {
  const int left = kMargin_px + (box_.last.y - y) * voxel_px_;
  const int top = kMargin_px + (box_.last.x - x) * voxel_px_;
  fill_rectangle(picture_, left, top, left + voxel_px_, top + voxel_px_, colour);
}

int FloorPlan::column_px(double y_m) const {
  return kMargin_px + whole_px((box_.last.y + 1 - y_m / voxel_m_) * voxel_px_);
}

int FloorPlan::row_px(double x_m) const {
  return kMargin_px + whole_px((box_.last.x + 1 - x_m / voxel_m_) * voxel_px_);
}

void FloorPlan::draw_ticks() {
  const auto metres_in = [this](std::int32_t first, std::int32_t last, auto&& draw) {
    const double end = (last + 1.0) * voxel_m_ / tick_m_;
    for (double tick = std::ceil(first * voxel_m_ / tick_m_); tick <= end; tick += 1.0) {
      draw(tick * tick_m_, std::fmod(tick, 5.0) == 0.0 ? kLongTick_px : kTick_px);
    }
  };
  const int right = picture_.width() - kMargin_px;
  const int bottom = picture_.height() - kMargin_px;
  metres_in(box_.first.y, box_.last.y, [&](double y_m, int length) {
    const int u = column_px(y_m);
    fill_rectangle(picture_, u, kMargin_px - 2 - length, u + 1, kMargin_px - 2, kInk);
    fill_rectangle(picture_, u, bottom + 2, u + 1, bottom + 2 + length, kInk);
  });
  metres_in(box_.first.x, box_.last.x, [&](double x_m, int length) {
    const int v = row_px(x_m);
    fill_rectangle(picture_, kMargin_px - 2 - length, v, kMargin_px - 2, v + 1, kInk);
    fill_rectangle(picture_, right + 2, v, right + 2 + length, v + 1, kInk);
  });
}

void FloorPlan::draw_scale_bar() {
  const int bar_px = whole_px(tick_m_ / voxel_m_ * voxel_px_);
  const int bottom = picture_.height() - 4;
  fill_rectangle(picture_, kMargin_px, bottom - 5, kMargin_px + bar_px, bottom, kInk);
  fill_rectangle(picture_, kMargin_px + bar_px / 2, bottom - 4, kMargin_px + bar_px - 1, bottom - 1,
                 kPaper);
}

void FloorPlan::draw_start() {
  if (!start_m_ || !start_m_->allFinite()) return;
  const int u = column_px(start_m_->y());
  const int v = row_px(start_m_->x());
  fill_rectangle(picture_, u - 6, v - 1, u + 7, v + 2, kStartInk);
  fill_rectangle(picture_, u - 1, v - 6, u + 2, v + 7, kStartInk);
}

void FloorPlan::draw_path(std::span<const Eigen::Vector3d> path) {
  if (path.empty()) return;
  const auto dot = [&](const Eigen::Vector3d& p, int half_px) {
    const int u = column_px(p.y()), v = row_px(p.x());
    fill_rectangle(picture_, u - half_px, v - half_px, u + half_px + 1, v + half_px + 1, kPathInk);
  };
  const double px_per_m = voxel_px_ / voxel_m_;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3d leg = path[i] - path[i - 1];
    const int steps = whole_px(std::ceil(leg.head<2>().norm() * px_per_m)) + 1;
    for (int k = 0; k <= steps; ++k) dot(path[i - 1] + leg * k / steps, 1);
  }
  dot(path.back(), 4);
}

Picture FloorPlan::finish(const ProjectionOptions& options) && {
  draw_path(options.path);
  draw_ticks();
  draw_scale_bar();
  draw_start();
  return std::move(picture_);
}

Columns::Columns(const BlockMap& map, const VoxelBox& box) {
  for_each_known_voxel(map, [&](const VoxelIndex& v, QuantizedLogOdds, Occupancy state) {
    if (v.z < box.first.z || v.z > box.last.z) return;
    Column& column = by_block_[block_of({v.x, v.y, 0})][offset_in_block({v.x, v.y, 0})];
    column.free += state == Occupancy::kFree ? 1 : 0;
    if (state != Occupancy::kOccupied) return;
    if (column.occupied++ == 0 || v.z > column.highest) column.highest = v.z;
  });
}

Column Columns::at(std::int32_t x, std::int32_t y) const {
  const auto found = by_block_.find(block_of({x, y, 0}));
  return found == by_block_.end() ? Column{} : found->second[offset_in_block({x, y, 0})];
}

std::int32_t layer_at(double m, double voxel_m) {
  constexpr double kFarthest = 1 << 30;
  const double layer = std::floor(m / voxel_m);
  return std::isnan(layer) ? 0
                           : static_cast<std::int32_t>(std::clamp(layer, -kFarthest, kFarthest));
}

std::optional<std::int32_t> lowest_matter(const BlockMap& map, const VoxelBox& box) {
  std::optional<std::int32_t> lowest;
  for_each_known_voxel(map, [&](const VoxelIndex& v, QuantizedLogOdds, Occupancy state) {
    if (state == Occupancy::kOccupied && box.contains(v))
      lowest = std::min(lowest.value_or(v.z), v.z);
  });
  return lowest;
}

VoxelBox cut_box(const VoxelBox& box, double voxel_m, const ProjectionOptions& options) {
  VoxelBox cut = box;
  if (!options.z_m) return cut;
  cut.last.z = std::clamp(layer_at(*options.z_m, voxel_m), box.first.z - 1, box.last.z);
  return cut;
}

}  // namespace swiftlet::render
