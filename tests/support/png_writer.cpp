// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "support/png_writer.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

struct Layout {
  int bits;
  int colour_type;
  int channels;
};

Layout layout_of(PngKind kind) {
  switch (kind) {
    case PngKind::kGrey8:
      return {8, PNG_COLOR_TYPE_GRAY, 1};
    case PngKind::kGreyAlpha16:
      return {16, PNG_COLOR_TYPE_GRAY_ALPHA, 2};
    case PngKind::kRgb8:
      return {8, PNG_COLOR_TYPE_RGB, 3};
    case PngKind::kRgb16:
      return {16, PNG_COLOR_TYPE_RGB, 3};
    case PngKind::kPalette8:
      return {8, PNG_COLOR_TYPE_PALETTE, 1};
    default:
      return {16, PNG_COLOR_TYPE_GRAY, 1};
  }
}

std::vector<png_byte> encode_row(std::span<const std::uint16_t> row, const Layout& layout) {
  std::vector<png_byte> bytes;
  for (const std::uint16_t value : row) {
    for (int channel = 0; channel < layout.channels; ++channel) {
      bytes.push_back(static_cast<png_byte>(value >> 8));  // PNG is big-endian
      if (layout.bits == 16) bytes.push_back(static_cast<png_byte>(value & 0xFF));
    }
  }
  return bytes;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

/// CRC-32 of PNG chunks (PNG specification, annex D), bit by bit.
std::uint32_t crc32_of(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& pixels,
               PngKind kind) {
  const Layout layout = layout_of(kind);
  std::vector<std::vector<png_byte>> rows;
  std::vector<png_bytep> row_pointers;
  for (int v = 0; v < pixels.height(); ++v) rows.push_back(encode_row(pixels.row(v), layout));
  for (auto& row : rows) row_pointers.push_back(row.data());

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                             std::fclose);
  ASSERT_NE(file, nullptr) << path;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);  // an encoder error aborts the test: no setjmp
  png_init_io(png, file.get());
  png_set_IHDR(png, info, static_cast<png_uint_32>(pixels.width()),
               static_cast<png_uint_32>(pixels.height()), layout.bits, layout.colour_type,
               kind == PngKind::kGrey16Interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (kind == PngKind::kPalette8) {
    const std::vector<png_color> palette(256);
    png_set_PLTE(png, info, palette.data(), 256);
  }
  if (kind == PngKind::kGrey16WithGamma) {
    png_color_8 significant{};
    significant.gray = 12;
    png_set_gAMA(png, info, 1.0 / 2.2);
    png_set_sBIT(png, info, &significant);
  }
  png_set_rows(png, info, row_pointers.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
}

void declare_png_size(const std::filesystem::path& path, std::uint32_t width,
                      std::uint32_t height) {
  // Signature (8), chunk length (4), "IHDR" (4), width (4), height (4), five more bytes, CRC (4).
  std::string bytes = content_of(path);
  ASSERT_GE(bytes.size(), 33U);
  bytes.replace(16, 8, big_endian(width) + big_endian(height));
  bytes.replace(29, 4, big_endian(crc32_of(std::string_view(bytes).substr(12, 17))));
  write_file(path, bytes);
}

}  // namespace swiftlet::test
