// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

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
/// Errors: kNotFound, kIo; kUnsupported for any other kind of PNG or a file of more than 64 MiB;
/// those of decode_depth_png().
[[nodiscard]] Expected<DepthImage> read_depth_png(const std::filesystem::path& path,
                                                  const DepthPngFormat& format);

/// The same of the bytes of such a file; `where` is for messages.
/// Errors: kUnsupported for any other kind of PNG, or more than 2^25 pixels; kCorruptInput if it is
/// truncated or damaged anywhere, is no PNG, has a side of 0 or more than 16384 pixels, or holds
/// far more bytes than its pixels take. Cost and memory: O(bytes + pixels), and no more pixels than
/// the bytes can hold. Chunks that are no image (texts, profiles, palettes) are skipped unread.
[[nodiscard]] Expected<DepthImage> decode_depth_png(std::string_view bytes,
                                                    const std::string& where,
                                                    const DepthPngFormat& format);

}  // namespace swiftlet
