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
#include <string>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/file/file_content.hpp"

namespace swiftlet {
namespace {

constexpr std::uint16_t kFullScale = std::numeric_limits<std::uint16_t>::max();
constexpr png_uint_32 kMaxSide = 16384;    // that of PinholeIntrinsics
constexpr std::size_t kDeflateMax = 1032;  // no byte of a deflate stream yields more

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
    png_set_user_limits(png_, kMaxSide, kMaxSide);
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

Status check_kind(const PngDecoder& png, const std::string& where, std::size_t file_size) {
  if (png.bits() != 16 || png.colour_type() != PNG_COLOR_TYPE_GRAY) {
    return fail(ErrorCode::kUnsupported, where,
                fmt::format("it is a {}-bit {} PNG, not a depth image", png.bits(),
                            name_of(png.colour_type())),
                "depth images are 16-bit greyscale");
  }
  // Before the pixels are allocated: a few bytes must not cost half a gigabyte.
  const std::size_t needed = 2 * to<std::size_t>(png.width()) * to<std::size_t>(png.height());
  if (needed / kDeflateMax > file_size) return damaged(where, "too short for its size");
  return Done{};
}

}  // namespace

Expected<DepthImage> read_depth_png(const std::filesystem::path& path,
                                    const DepthPngFormat& format) {
  const std::string where = path.string();
  auto file = read_file(path, kMostImageBytes);
  if (!file) return forward_error(std::move(file));
  if (file->empty()) return damaged(where, "the file is empty");

  PngDecoder png(*file);
  if (!png.read_header()) return damaged(where, png.message());
  if (auto usable = check_kind(png, where, file->size()); !usable)
    return forward_error(std::move(usable));

  DepthImage depth{Image<std::uint16_t>(png.width(), png.height()), format.unit_m};
  if (!png.read_pixels(depth.raw)) return damaged(where, png.message());
  if (format.is_full_scale_invalid)
    std::ranges::replace(depth.raw.pixels(), kFullScale, std::uint16_t{0});
  return depth;
}

}  // namespace swiftlet
