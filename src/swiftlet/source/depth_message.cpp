// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/depth_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kMaxSide = 16384;

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

std::uint16_t steps_of(float depth_m, float unit_m) {
  const float steps = std::round(depth_m / unit_m);
  constexpr float kMax = std::numeric_limits<std::uint16_t>::max();
  return steps > 0.0F && steps <= kMax ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
}

}  // namespace

bool may_be_depth(std::string_view encoding) {
  return encoding == "16UC1" || encoding == "mono16" || is_float(encoding);
}

tl::expected<DepthImage, std::string> depth_from_message(const ros::Image& image, float unit_m) {
  if (!may_be_depth(image.encoding))
    return tl::make_unexpected(fmt::format("its encoding '{}' is not depth", image.encoding));
  if (!(unit_m > 0.0F) || !std::isfinite(unit_m))
    return tl::make_unexpected(fmt::format("its depth unit of {} m cannot be", unit_m));
  const std::size_t pixel_bytes = is_float(image.encoding) ? sizeof(float) : sizeof(std::uint16_t);
  if (image.width == 0 || image.height == 0 || image.width > kMaxSide || image.height > kMaxSide)
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
  if (info.width > kMaxSide || info.height > kMaxSide)
    return fail(ErrorCode::kCorruptInput, where, "its image size cannot be");
  auto intrinsics = PinholeIntrinsics::create(to<int>(info.width), to<int>(info.height), info.K[0],
                                              info.K[4], info.K[2], info.K[5]);
  if (!intrinsics) intrinsics.error().where = where;
  return intrinsics;
}

}  // namespace swiftlet
