// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/source/depth_png.hpp"
#include "swiftlet/source/intrinsics_note.hpp"

namespace swiftlet {

/// Checks that a folder is there, is a folder, and is not empty. `content` says what belongs in it.
/// Errors: kUsage if no folder is named; kNotFound, kIo.
[[nodiscard]] Status check_folder(const std::filesystem::path& folder, std::string_view content);

/// The published calibration of a dataset [px]; it holds for 640 x 480 images.
struct KnownCamera {
  std::string_view name;
  double fx_px, fy_px, cx_px, cy_px;
};

/// What the camera of a recorded folder is opened with.
struct FolderCameraRequest {
  std::filesystem::path folder;
  DepthPngFormat format;
  std::string intrinsics{};            ///< "fx,fy,cx,cy" or a file, as the user says; may be empty
  std::optional<KnownCamera> known{};  ///< if the recording was recognised as a dataset's
  std::string recognised_by{};         ///< what it was recognised by, for people
};

/// The depth camera of a recorded folder: one image size, one set of intrinsics.
/// The intrinsics are those that the user gives, else of `camera-intrinsics.txt` (3 x 3, zero skew)
/// in the folder, else the calibration of the dataset that it was recognised as. Nothing is
/// guessed.
class FolderCamera {
 public:
  /// Takes the size from the first of `images` that can be read.
  /// Errors: that of the first image if none can; those of read_matrix3(); kUsage or kCorruptInput
  /// if the intrinsics are no four numbers, singular or not finite; kUnsupported if they have skew;
  /// kNotFound if nobody tells them.
  [[nodiscard]] static Expected<FolderCamera> open(
      const FolderCameraRequest& request, const std::vector<std::filesystem::path>& images);

  /// Errors: those of read_depth_png(); kCorruptInput if the size is not that of the first image.
  [[nodiscard]] Expected<DepthFrame> read(const std::filesystem::path& image, Stamp stamp) const;

  /// Where the intrinsics came from.
  [[nodiscard]] const IntrinsicsNote& note() const { return note_; }

 private:
  FolderCamera(const DepthPngFormat& format, const PinholeIntrinsics& intrinsics,
               IntrinsicsNote note)
      : format_(format), intrinsics_(intrinsics), note_(std::move(note)) {}

  DepthPngFormat format_;
  PinholeIntrinsics intrinsics_;
  IntrinsicsNote note_;
};

}  // namespace swiftlet
