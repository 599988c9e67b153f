// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet {

/// How a recording writes depth into its images.
struct DepthPngFormat {
  float unit_m = 0.001F;               ///< metres per step of the pixel value
  bool is_full_scale_invalid = false;  ///< 65535 marks "no reading", as 0 always does
};

/// Reads a 16-bit greyscale PNG, interlaced or not; values are taken as they stand, whatever gamma
/// the file declares.
/// Errors: kNotFound, kIo; kUnsupported for any other kind of PNG; kCorruptInput if it is truncated
/// or damaged anywhere, is no PNG, or has a side of 0 or more than 16384 pixels.
[[nodiscard]] Expected<DepthImage> read_depth_png(const std::filesystem::path& path,
                                                  const DepthPngFormat& format);

}  // namespace swiftlet
