// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/source/depth_png.hpp"

namespace swiftlet {

/// Checks that a folder is there, is a folder, and is not empty. `content` says
/// what belongs in it. Errors: kUsage if no folder is named; kNotFound, kIo.
[[nodiscard]] Status check_folder(const std::filesystem::path& folder, std::string_view content);

/// Published intrinsics of a kind of recording [px]; they hold for 640 x 480
/// images.
struct PinholePreset {
  double fx_px, fy_px, cx_px, cy_px;
};

/// The depth camera of a recorded folder: one image size, one set of
/// intrinsics. The intrinsics are those of `camera-intrinsics.txt` (3 x 3, zero
/// skew) if the folder has one, else the preset of its kind.
class FolderCamera {
 public:
  /// Takes the size from the first of `images` that can be read. Errors: that
  /// of the first image if none can; those of read_matrix3(); kCorruptInput if
  /// the intrinsics are singular or not finite; kUnsupported if they have skew,
  /// or if a preset would be applied to another size than its own.
  [[nodiscard]] static Expected<FolderCamera> open(const std::filesystem::path& folder,
                                                   const std::vector<std::filesystem::path>& images,
                                                   const DepthPngFormat& format,
                                                   const PinholePreset& preset);

  /// Errors: those of read_depth_png(); kCorruptInput if the size is not that
  /// of the first image.
  [[nodiscard]] Expected<DepthFrame> read(const std::filesystem::path& image, Stamp stamp) const;

 private:
  FolderCamera(const DepthPngFormat& format, const PinholeIntrinsics& intrinsics)
      : format_(format), intrinsics_(intrinsics) {}

  DepthPngFormat format_;
  PinholeIntrinsics intrinsics_;
};

}  // namespace swiftlet
