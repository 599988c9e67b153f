// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/depth_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kMaxImageSide = 16384;

bool is_float(std::string_view encoding) { return encoding == "32FC1"; }

/// One value of a row, whatever the byte order of the writer.
template <class Value>
Value value_at(const std::byte* row, std::uint32_t column, bool is_big_endian) {
  std::array<std::byte, sizeof(Value)> raw{};
  std::memcpy(raw.data(), row + std::size_t{column} * sizeof(Value), sizeof(Value));
  if (is_big_endian) std::ranges::reverse(raw);
  Value value{};
  std::memcpy(&value, raw.data(), sizeof(Value));
  return value;
}

/// K of an image that has one pixel for so many of the sensor.
void bin(std::array<double, 9>& K, double bin_x, double bin_y) {
  K[0] /= bin_x;
  K[2] /= bin_x;
  K[4] /= bin_y;
  K[5] /= bin_y;
}

/// How far the principal point lies from the middle, in image sizes.
double off_centre(const std::array<double, 9>& K, int width, int height) {
  return std::max(std::abs(K[2] / width - 0.5), std::abs(K[5] / height - 0.5));
}

}  // namespace

bool may_be_depth(std::string_view encoding) {
  return encoding == "16UC1" || encoding == "mono16" || is_float(encoding);
}

std::uint16_t steps_of(float depth_m, float unit_m) {
  const float steps = std::round(depth_m / unit_m);
  constexpr float kMax = std::numeric_limits<std::uint16_t>::max();
  return steps > 0.0F && steps <= kMax ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
}

tl::expected<DepthImage, std::string> depth_from_message(const ros::Image& image, float unit_m) {
  if (!may_be_depth(image.encoding))
    return tl::make_unexpected(fmt::format("its encoding '{}' is not depth", image.encoding));
  if (!(unit_m > 0.0F) || !std::isfinite(unit_m))
    return tl::make_unexpected(fmt::format("its depth unit of {} m cannot be", unit_m));
  const std::size_t pixel_bytes = is_float(image.encoding) ? sizeof(float) : sizeof(std::uint16_t);
  if (image.width == 0 || image.height == 0 || image.width > kMaxImageSide ||
      image.height > kMaxImageSide)
    return tl::make_unexpected(fmt::format("{} x {} pixels cannot be", image.width, image.height));
  if (image.step < image.width * pixel_bytes ||
      image.data.size() < std::size_t{image.step} * image.height) {
    return tl::make_unexpected(fmt::format("{} bytes are too few for {} x {} pixels",
                                           image.data.size(), image.width, image.height));
  }
  DepthImage depth{Image<std::uint16_t>(to<int>(image.width), to<int>(image.height)), unit_m};
  for (std::uint32_t v = 0; v < image.height; ++v) {
    const std::byte* row = image.data.data() + std::size_t{v} * image.step;
    const auto out = depth.raw.row(to<int>(v));
    for (std::uint32_t u = 0; u < image.width; ++u) {
      out[u] = is_float(image.encoding)
                   ? steps_of(value_at<float>(row, u, image.is_big_endian), unit_m)
                   : value_at<std::uint16_t>(row, u, image.is_big_endian);
    }
  }
  return depth;
}

Expected<PinholeIntrinsics> intrinsics_from_message(const ros::CameraInfo& info,
                                                    const std::string& where) {
  if (std::ranges::any_of(info.D, [](double d) { return d != 0.0; })) {
    return fail(ErrorCode::kUnsupported, where,
                fmt::format("its images have lens distortion ({})", info.distortion_model),
                "use the rectified depth of the device, as in depth/image_rect_raw");
  }
  if (info.width > kMaxImageSide || info.height > kMaxImageSide)
    return fail(ErrorCode::kCorruptInput, where, "its image size cannot be");
  auto intrinsics = PinholeIntrinsics::create(to<int>(info.width), to<int>(info.height), info.K[0],
                                              info.K[4], info.K[2], info.K[5]);
  if (!intrinsics) intrinsics.error().where = where;
  return intrinsics;
}

std::optional<double> smooth_share(const DepthImage& depth) {
  constexpr std::size_t kFewest = 100;
  std::size_t pairs = 0, smooth = 0;
  for (int v = 0; v < depth.raw.height(); ++v) {
    const auto row = depth.raw.row(v);
    for (std::size_t u = 1; u < row.size(); ++u) {
      const int a = row[u - 1], b = row[u];
      if (a == 0 || b == 0) continue;
      ++pairs;
      smooth += 20 * std::abs(a - b) < std::min(a, b) ? 1 : 0;
    }
  }
  if (pairs < kFewest) return std::nullopt;
  return static_cast<double>(smooth) / static_cast<double>(pairs);
}

Expected<PinholeIntrinsics> intrinsics_of_images(const ros::CameraInfo& info, int width, int height,
                                                 const std::string& where) {
  const double bin_x = std::max(1U, info.binning_x), bin_y = std::max(1U, info.binning_y);
  const bool has_region = info.region.width > 0 && info.region.height > 0;
  const double seen_x = has_region ? info.region.width : info.width;
  const double seen_y = has_region ? info.region.height : info.height;
  ros::CameraInfo own = info;
  own.width = to<std::uint32_t>(width);
  own.height = to<std::uint32_t>(height);
  if (std::floor(seen_x / bin_x) == width && std::floor(seen_y / bin_y) == height) {
    if (has_region) {
      own.K[2] -= info.region.x;
      own.K[5] -= info.region.y;
    }
    bin(own.K, bin_x, bin_y);
  } else if (info.width != own.width || info.height != own.height) {
    return fail(ErrorCode::kCorruptInput, where,
                fmt::format("the image has another size than its CameraInfo: {} x {}, not {} x {}",
                            width, height, std::floor(seen_x / bin_x), std::floor(seen_y / bin_y)),
                "record the CameraInfo of these images, or name it with --info-topic");
  } else {
    std::array<double, 9> binned = info.K;
    bin(binned, bin_x, bin_y);
    if (off_centre(binned, width, height) < off_centre(own.K, width, height)) own.K = binned;
  }
  return intrinsics_from_message(own, where);
}

}  // namespace swiftlet
