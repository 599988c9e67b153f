// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/body_box.hpp"

#include <algorithm>
#include <limits>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

struct Range {
  double from, to;
};

/// The part of the line origin + s * direction, s >= 0, that is in a box (slab method).
std::optional<Range> within(const BodyBox& box, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction) {
  Range range{0.0, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < box.from_m[axis] || origin[axis] > box.to_m[axis]) return std::nullopt;
      continue;
    }
    const double a = (box.from_m[axis] - origin[axis]) / direction[axis];
    const double b = (box.to_m[axis] - origin[axis]) / direction[axis];
    range.from = std::max(range.from, std::min(a, b));
    range.to = std::min(range.to, std::max(a, b));
  }
  if (range.from > range.to) return std::nullopt;
  return range;
}

}  // namespace

BodyBoxMask::BodyBoxMask(const BodyBox& box, const Transform<Body, Camera>& T_body_camera,
                         const PinholeIntrinsics& intrinsics)
    : intrinsics_(intrinsics) {
  std::uint32_t pixel = 0;
  for (int v = 0; v < intrinsics.height(); ++v) {
    for (int u = 0; u < intrinsics.width(); ++u, ++pixel) {
      const Eigen::Vector3d ray = T_body_camera.rotation() * intrinsics.back_project(u, v, 1.0);
      const auto range = within(box, T_body_camera.translation(), ray);
      if (range)
        stretches_.push_back(
            {pixel, static_cast<float>(range->from), static_cast<float>(range->to)});
    }
  }
}

void BodyBoxMask::clear(DepthImage& depth) const {
  SWIFTLET_REQUIRE(
      depth.raw.width() == intrinsics_.width() && depth.raw.height() == intrinsics_.height(),
      "the mask is that of another camera");
  const auto pixels = depth.raw.pixels();
  for (const Stretch& stretch : stretches_) {
    const float z_m = static_cast<float>(pixels[stretch.pixel]) * depth.unit_m;
    if (z_m >= stretch.from_m && z_m <= stretch.to_m) pixels[stretch.pixel] = 0;
  }
}

}  // namespace swiftlet
