// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/depth_png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/file/file_content.hpp"

namespace swiftlet {
namespace {

constexpr std::uint16_t kFullScale = std::numeric_limits<std::uint16_t>::max();
constexpr png_uint_32 kMostSide_px = 16384;                // that of PinholeIntrinsics
constexpr std::size_t kMostPixels = std::size_t{1} << 25;  // 8192 x 4096
constexpr std::size_t kDeflateMax = 1032;  // no byte of a deflate stream yields more
constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
// What a writer may add to the pixels: texts, profiles, and the frames of chunks.
constexpr std::size_t kMostExtraBytes = std::size_t{4} << 20;

// The chunks that libpng would interpret otherwise, as it wants them: names that end in a zero.
constexpr std::size_t kChunkName = 5;
constexpr auto kIgnored = std::to_array<png_byte>(
    {'b', 'K', 'G', 'D', 0,   'c', 'H', 'R', 'M', 0,   'e', 'X', 'I', 'f', 0,   'g', 'A', 'M',
     'A', 0,   'h', 'I', 'S', 'T', 0,   'i', 'C', 'C', 'P', 0,   'i', 'T', 'X', 't', 0,   'o',
     'F', 'F', 's', 0,   'p', 'C', 'A', 'L', 0,   'p', 'H', 'Y', 's', 0,   's', 'B', 'I', 'T',
     0,   's', 'C', 'A', 'L', 0,   's', 'P', 'L', 'T', 0,   's', 'R', 'G', 'B', 0,   't', 'E',
     'X', 't', 0,   't', 'I', 'M', 'E', 0,   't', 'R', 'N', 'S', 0,   'z', 'T', 'X', 't', 0});

/// One decoding. libpng reports errors by longjmp, which must not skip destructors: read_header()
/// and read_pixels() are the only places it lands, and between them and libpng nothing has any.
class PngDecoder {
 public:
  explicit PngDecoder(std::string_view file)
      : rest_(file),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)) {
    if (png_ == nullptr) return;
    info_ = png_create_info_struct(png_);
    png_set_read_fn(png_, this, on_read);
    png_set_user_limits(png_, kMostSide_px, kMostSide_px);
    png_set_chunk_cache_max(png_, 64);
    png_set_chunk_malloc_max(png_, std::size_t{1} << 20);
    // Everything but header, pixels and end is passed over: a text may inflate to gigabytes.
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, kIgnored.data(),
                                to<int>(kIgnored.size() / kChunkName));
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  [[nodiscard]] bool read_header() {
    if (png_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    return true;
  }

  /// REQUIRES: `image` has the size of the header, which says 16-bit greyscale.
  [[nodiscard]] bool read_pixels(Image<std::uint16_t>& image) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    const int passes = png_set_interlace_handling(png_);
    for (int pass = 0; pass < passes; ++pass) {
      for (int v = 0; v < image.height(); ++v) {
        png_read_row(png_, reinterpret_cast<png_bytep>(image.row(v).data()), nullptr);
      }
    }
    png_read_end(png_, nullptr);  // a file cut short after its last pixel is still cut short
    return true;
  }

  [[nodiscard]] int width() const { return to<int>(png_get_image_width(png_, info_)); }
  [[nodiscard]] int height() const { return to<int>(png_get_image_height(png_, info_)); }
  [[nodiscard]] int bits() const { return png_get_bit_depth(png_, info_); }
  [[nodiscard]] int colour_type() const { return png_get_color_type(png_, info_); }
  [[nodiscard]] const char* message() const { return message_.data(); }

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::snprintf(self->message_.data(), self->message_.size(), "%s", message);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}  // a library does not print
  static void on_read(png_structp png, png_bytep out, std::size_t size) {
    auto* self = static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (self->rest_.size() < size) png_error(png, "the file ends too early");
    std::memcpy(out, self->rest_.data(), size);
    self->rest_.remove_prefix(size);
  }

  std::string_view rest_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::array<char, 128> message_{"libpng is not of the version it was built for"};
};

std::string_view name_of(int colour_type) {
  switch (colour_type) {
    case PNG_COLOR_TYPE_GRAY:
      return "greyscale";
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return "greyscale with alpha";
    case PNG_COLOR_TYPE_PALETTE:
      return "palette";
    case PNG_COLOR_TYPE_RGB:
      return "RGB";
    default:
      return "RGB with alpha";
  }
}

tl::unexpected<Error> damaged(const std::string& where, std::string_view reason) {
  return fail(ErrorCode::kCorruptInput, where, fmt::format("damaged PNG: {}", reason),
              "copy or record it again");
}

/// The size that the header declares, before libpng has seen a byte; nullopt if there is no header
/// where it belongs.
std::optional<std::pair<std::size_t, std::size_t>> declared_size(std::string_view file) {
  constexpr std::size_t kNameAt = 12;  // behind signature and length
  if (file.size() < kNameAt + 12 || file.substr(kNameAt, 4) != "IHDR") return std::nullopt;
  const auto number_at = [&](std::size_t at) {
    std::size_t value = 0;
    for (const char c : file.substr(at, 4)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  };
  return std::pair(number_at(kNameAt + 4), number_at(kNameAt + 8));
}

/// Work and memory go with what the file holds, not with what it says of itself.
Status check_budget(std::string_view file, const std::string& where) {
  const auto size = declared_size(file);
  // libpng would find a header behind other chunks, too, and say too late what it declares.
  if (!size && file.starts_with(kSignature))
    return damaged(where, "it does not begin with a header");
  if (!size || size->first > kMostSide_px || size->second > kMostSide_px)
    return Done{};  // libpng tells
  const std::size_t pixels = size->first * size->second;
  if (2 * pixels / kDeflateMax > file.size()) return damaged(where, "too short for its size");
  if (pixels > kMostPixels) {
    return fail(ErrorCode::kUnsupported, where,
                fmt::format("{} x {} pixels are more than the {} of the largest image that is read",
                            size->first, size->second, kMostPixels),
                "is it a depth image?");
  }
  // Deflate never makes more than a thousandth more of what it cannot shrink.
  const std::size_t most_bytes = 2 * pixels + pixels / 64 + kMostExtraBytes;
  if (file.size() > most_bytes) {
    return fail(ErrorCode::kCorruptInput, where,
                fmt::format("{} bytes are too many for {} x {} pixels", file.size(), size->first,
                            size->second),
                "write it again without texts and profiles");
  }
  return Done{};
}

Status check_kind(const PngDecoder& png, const std::string& where) {
  if (png.bits() == 16 && png.colour_type() == PNG_COLOR_TYPE_GRAY) return Done{};
  return fail(ErrorCode::kUnsupported, where,
              fmt::format("it is a {}-bit {} PNG, not a depth image", png.bits(),
                          name_of(png.colour_type())),
              "depth images are 16-bit greyscale");
}

}  // namespace

Expected<DepthImage> decode_depth_png(std::string_view bytes, const std::string& where,
                                      const DepthPngFormat& format) {
  if (bytes.empty()) return damaged(where, "the file is empty");
  if (auto usable = check_budget(bytes, where); !usable) return forward_error(std::move(usable));

  PngDecoder png(bytes);
  if (!png.read_header()) return damaged(where, png.message());
  if (auto usable = check_kind(png, where); !usable) return forward_error(std::move(usable));

  DepthImage depth{Image<std::uint16_t>(png.width(), png.height()), format.unit_m};
  if (!png.read_pixels(depth.raw)) return damaged(where, png.message());
  if (format.is_full_scale_invalid)
    std::ranges::replace(depth.raw.pixels(), kFullScale, std::uint16_t{0});
  return depth;
}

Expected<DepthImage> read_depth_png(const std::filesystem::path& path,
                                    const DepthPngFormat& format) {
  auto file = read_file(path, kMostImageBytes);
  if (!file) return forward_error(std::move(file));
  return decode_depth_png(*file, path.string(), format);
}

}  // namespace swiftlet
