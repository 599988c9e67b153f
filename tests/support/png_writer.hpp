// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>

#include "swiftlet/base/image.hpp"

namespace swiftlet::test {

/// The kinds of PNG that a user may mistake for a depth image, and those that are one.
enum class PngKind {
  kGrey16,
  kGrey16Interlaced,
  kGrey16WithGamma,  ///< declares gamma 1/2.2 and 12 significant bits; a reader must not apply them
  kGrey8,
  kGreyAlpha16,
  kRgb8,
  kRgb16,
  kPalette8,
};

/// Writes with libpng's own encoder. The grey kinds carry `pixels` (8 bits: the upper byte); the
/// others repeat it in every channel.
void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& pixels,
               PngKind kind = PngKind::kGrey16);

/// Overwrites the size that a PNG's header declares, check sum included.
void declare_png_size(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height);

}  // namespace swiftlet::test
