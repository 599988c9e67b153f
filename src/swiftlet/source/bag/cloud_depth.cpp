// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/cloud_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "swiftlet/source/bag/depth_message.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kMostSide = 16384;
constexpr double kMostResidual_px = 1.0;
constexpr double kFewestPoints = 100;

/// The straight line pixel = focal * slope + centre through many points, by least squares.
class PixelFit {
 public:
  void add(double slope, double pixel) {
    ++n_;
    s_ += slope;
    p_ += pixel;
    ss_ += slope * slope;
    sp_ += slope * pixel;
    pp_ += pixel * pixel;
  }
  [[nodiscard]] bool is_enough() const { return n_ >= kFewestPoints && spread() > 1e-9; }
  [[nodiscard]] double focal() const { return (sp_ / n_ - s_ / n_ * (p_ / n_)) / spread(); }
  [[nodiscard]] double centre() const { return p_ / n_ - focal() * s_ / n_; }
  [[nodiscard]] double residual_px() const {
    const double variance = pp_ / n_ - p_ / n_ * (p_ / n_);
    return std::sqrt(std::max(0.0, variance - focal() * focal() * spread()));
  }

 private:
  [[nodiscard]] double spread() const { return ss_ / n_ - s_ / n_ * (s_ / n_); }
  double n_ = 0, s_ = 0, p_ = 0, ss_ = 0, sp_ = 0, pp_ = 0;
};

/// Where x, y and z are in a point.
std::optional<std::array<std::uint32_t, 3>> offsets_of(const ros::PointCloud& cloud) {
  std::array<std::uint32_t, 3> offsets{};
  constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto field = std::ranges::find(cloud.fields, kNames[i], &ros::PointField::name);
    if (field == cloud.fields.end() || field->datatype != ros::PointField::kFloat32 ||
        std::uint64_t{field->offset} + sizeof(float) > cloud.point_step)
      return std::nullopt;
    offsets[i] = field->offset;
  }
  return offsets;
}

float float_at(const std::byte* place, bool is_big_endian) {
  std::array<std::byte, sizeof(float)> raw{};
  std::memcpy(raw.data(), place, raw.size());
  if (is_big_endian) std::ranges::reverse(raw);
  return std::bit_cast<float>(raw);
}

std::optional<std::string> fault_of(const ros::PointCloud& cloud) {
  if (cloud.height < 2) return "its points are a heap and no image (height 1)";
  if (cloud.width == 0 || cloud.width > kMostSide || cloud.height > kMostSide)
    return fmt::format("{} x {} points cannot be", cloud.width, cloud.height);
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.row_step < row || cloud.data.size() / cloud.height < cloud.row_step)
    return fmt::format("{} bytes are too few for {} x {} points", cloud.data.size(), cloud.width,
                       cloud.height);
  return std::nullopt;
}

}  // namespace

tl::expected<CloudDepth, std::string> depth_from_cloud(const ros::PointCloud& cloud, float unit_m) {
  if (auto fault = fault_of(cloud)) return tl::make_unexpected(std::move(*fault));
  const auto offsets = offsets_of(cloud);
  if (!offsets) return tl::make_unexpected("its points have no x, y and z as floats");
  if (!(unit_m > 0.0F) || !std::isfinite(unit_m))
    return tl::make_unexpected(fmt::format("its depth unit of {} m cannot be", unit_m));
  CloudDepth seen{
      {Image<std::uint16_t>(static_cast<int>(cloud.width), static_cast<int>(cloud.height)),
       unit_m}};
  PixelFit columns, rows;
  for (std::uint32_t v = 0; v < cloud.height; ++v) {
    const auto out = seen.depth.raw.row(static_cast<int>(v));
    const std::byte* point = cloud.data.data() + std::size_t{v} * cloud.row_step;
    for (std::uint32_t u = 0; u < cloud.width; ++u, point += cloud.point_step) {
      const float x = float_at(point + (*offsets)[0], cloud.is_big_endian);
      const float y = float_at(point + (*offsets)[1], cloud.is_big_endian);
      const float z = float_at(point + (*offsets)[2], cloud.is_big_endian);
      out[u] = steps_of(z, unit_m);
      if (out[u] == 0 || !std::isfinite(x) || !std::isfinite(y)) continue;
      columns.add(double{x} / z, u);
      rows.add(double{y} / z, v);
    }
  }
  if (!columns.is_enough() || !rows.is_enough()) return seen;
  if (columns.residual_px() > kMostResidual_px || rows.residual_px() > kMostResidual_px)
    return tl::make_unexpected(
        "its points are not seen through their pixels: they are not in the optical frame of the "
        "camera, or were moved there from another one");
  seen.fx = columns.focal();
  seen.fy = rows.focal();
  seen.cx = columns.centre();
  seen.cy = rows.centre();
  return seen;
}

}  // namespace swiftlet
