// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/rig/world_axes.hpp"

namespace swiftlet {

/// What a user may say of a recorded folder that its layout leaves open.
struct FolderOptions {
  std::filesystem::path folder;
  std::optional<float> depth_unit_m{};  ///< metres per step of the images
  std::string intrinsics{};             ///< "fx,fy,cx,cy" [px] or a file; empty: found
  std::optional<WorldAxes> up{};        ///< which axis of the recording points up
  Nanoseconds time_offset{0};           ///< added to the stamps of images
};

/// Reads one of the options below into `options`; false if it is none or cannot be meant.
[[nodiscard]] bool apply_depth_unit(std::string_view key, std::string_view value,
                                    FolderOptions& options);
[[nodiscard]] bool apply_time_offset(std::string_view key, std::string_view value,
                                     FolderOptions& options);

/// Reads `FOLDER?depth_unit_m=0.001&up=+z&intrinsics=fx,fy,cx,cy&time_offset_ms=20`; a layout
/// without a clock has no time_offset_ms.
/// Errors: kUsage for an option that is not known or cannot be meant.
[[nodiscard]] Expected<FolderOptions> parse_folder_options(std::string_view rest,
                                                           std::string_view kind, bool has_clock);

}  // namespace swiftlet
