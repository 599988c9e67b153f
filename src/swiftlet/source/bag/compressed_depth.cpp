// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/compressed_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swiftlet/bag/byte_cursor.hpp"
#include "swiftlet/source/bag/depth_message.hpp"
#include "swiftlet/source/depth_png.hpp"

namespace swiftlet {
namespace {

using ByteSpan = std::span<const std::byte>;
using Raw = tl::expected<Image<std::uint16_t>, std::string>;

constexpr std::string_view kTransport = "compressedDepth";
constexpr std::size_t kConfigBytes = 12;
constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n";

bool is_png(ByteSpan bytes) { return ByteCursor::text_of(bytes).starts_with(kPngMagic); }

ByteSpan behind_config(ByteSpan bytes) {
  return bytes.subspan(std::min(kConfigBytes, bytes.size()));
}

/// "16UC1; compressedDepth png" is "16UC1".
std::string_view pixel_encoding(std::string_view format) {
  const std::string_view encoding = format.substr(0, format.find(';'));
  return encoding.substr(0, encoding.find_last_not_of(' ') + 1);
}

/// A PNG of 16 bits a channel, grey, by its header.
bool is_deep_png(ByteSpan bytes) {
  constexpr std::size_t kBitsAt = 24;
  return is_png(bytes) && bytes.size() > kBitsAt + 1 && bytes[kBitsAt] == std::byte{16} &&
         bytes[kBitsAt + 1] == std::byte{0};
}

Raw decode_png(ByteSpan bytes) {
  auto depth = decode_depth_png(ByteCursor::text_of(bytes), "", {});
  if (!depth) return tl::make_unexpected(depth.error().what);
  return std::move(depth->raw);
}

/// Depth in metres by quantised inverse: z = a / (q - b); q = 0 is no reading.
void metres_from_inverse(Image<std::uint16_t>& raw, float a, float b, float unit_m) {
  for (std::uint16_t& q : raw.pixels()) {
    const float z_m = q == 0 ? 0.0F : a / (static_cast<float>(q) - b);
    q = steps_of(z_m, unit_m);
  }
}

/// The numbers of RVL: three bits at a time, the lowest first, in words of eight groups, each with
/// a bit that says whether more follow.
class RvlNumbers {
 public:
  explicit RvlNumbers(ByteSpan bytes) : cursor_(bytes) {}
  [[nodiscard]] bool is_good() const { return cursor_.is_good(); }
  std::uint32_t next() {
    std::uint32_t value = 0;
    for (unsigned bits = 0; bits < 32; bits += 3) {
      const std::uint32_t group = next_group();
      value |= (group & 7U) << bits;
      if ((group & 8U) == 0) break;
    }
    return value;
  }

 private:
  std::uint32_t next_group() {
    if (groups_ == 0) {
      word_ = cursor_.read<std::uint32_t>();
      groups_ = 8;
    }
    const std::uint32_t group = word_ >> 28U;
    word_ <<= 4U;
    --groups_;
    return group;
  }

  ByteCursor cursor_;
  std::uint32_t word_ = 0;
  unsigned groups_ = 0;
};

}  // namespace

std::string_view encoding_of_compressed(const ros::CompressedImage& image) {
  const std::string_view encoding = pixel_encoding(image.format);
  if (image.format.find(kTransport) != std::string_view::npos)
    return may_be_depth(encoding) ? encoding : std::string_view{};
  if (!is_deep_png(image.data)) return {};
  return encoding == "mono16" ? encoding : "16UC1";
}

tl::expected<Image<std::uint16_t>, std::string> decode_rvl(ByteSpan bytes) {
  constexpr std::uint32_t kMostSide = 16384;
  ByteCursor size(bytes);
  const auto columns = size.read<std::uint32_t>(), rows = size.read<std::uint32_t>();
  if (!size.is_good() || columns == 0 || rows == 0 || columns > kMostSide || rows > kMostSide)
    return tl::make_unexpected(fmt::format("{} x {} pixels cannot be", columns, rows));
  // Zeros take next to no bytes, so that an image without any reading may be short; not a large
  // one.
  constexpr std::uint64_t kFreePixels = 1U << 22U, kPixelsAByte = 8;
  const std::uint64_t pixels = std::uint64_t{columns} * rows;
  if (pixels > kFreePixels + kPixelsAByte * bytes.size())
    return tl::make_unexpected(
        fmt::format("{} bytes are too few for {} x {} pixels", bytes.size(), columns, rows));
  Image<std::uint16_t> image(static_cast<int>(columns), static_cast<int>(rows));
  const auto out = image.pixels();
  RvlNumbers numbers(bytes.subspan(2 * sizeof(std::uint32_t)));
  std::uint32_t previous = 0;
  for (std::uint64_t at = 0; at < pixels;) {
    const std::uint64_t zeros = numbers.next(), readings = numbers.next();
    if (!numbers.is_good() || zeros + readings > pixels - at || zeros + readings == 0)
      return tl::make_unexpected("its RVL data are damaged");
    at += zeros;  // they are 0 already
    for (const std::uint64_t end = at + readings; at < end; ++at) {
      const std::uint32_t zigzag = numbers.next();
      previous += (zigzag >> 1U) ^ (0U - (zigzag & 1U));
      out[at] = static_cast<std::uint16_t>(previous);
    }
  }
  if (!numbers.is_good()) return tl::make_unexpected("its RVL data end too early");
  return image;
}

tl::expected<DepthImage, std::string> depth_from_compressed(const ros::CompressedImage& image,
                                                            float unit_m) {
  const std::string_view encoding = encoding_of_compressed(image);
  if (encoding.empty())
    return tl::make_unexpected(fmt::format("its format '{}' is not depth", image.format));
  if (!(unit_m > 0.0F) || !std::isfinite(unit_m))
    return tl::make_unexpected(fmt::format("its depth unit of {} m cannot be", unit_m));
  const bool has_config = !is_png(image.data);
  const ByteSpan packed = has_config ? behind_config(image.data) : image.data;
  Raw raw = is_png(packed) ? decode_png(packed) : decode_rvl(packed);
  if (!raw) return tl::make_unexpected(raw.error());
  if (encoding == "32FC1") {
    if (!has_config) return tl::make_unexpected("it does not say how its metres were quantised");
    ByteCursor config(image.data);
    config.skip(sizeof(std::int32_t));  // the kind of quantisation, of which there is one
    const auto a = config.read<float>(), b = config.read<float>();
    metres_from_inverse(*raw, a, b, unit_m);
  }
  return DepthImage{std::move(*raw), unit_m};
}

}  // namespace swiftlet
