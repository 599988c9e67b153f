// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace swiftlet {

/// Who told the intrinsics of a source's cameras.
enum class IntrinsicsOrigin : std::uint8_t {
  kUntold,        ///< the source does not say
  kFile,          ///< a file of the recording, or one that the user names
  kOption,        ///< the user, in the address of the source
  kKnownDataset,  ///< the published calibration of a dataset that was recognised
  kCameraInfo,    ///< CameraInfo messages of the recording
  kSdk,           ///< the camera itself, asked by its SDK
  kSimulator,     ///< the scene
};
inline constexpr std::array<std::string_view, 7> kIntrinsicsOriginNames{
    "untold", "file", "option", "known_dataset", "camera_info", "sdk", "simulator"};

/// Where the intrinsics of a source's cameras came from: wrong ones bend the map without a sign.
struct IntrinsicsNote {
  IntrinsicsOrigin origin = IntrinsicsOrigin::kUntold;
  std::string detail{};  ///< the file, the dataset, the topic; may be empty
};

[[nodiscard]] constexpr std::string_view name_of(IntrinsicsOrigin origin) {
  return kIntrinsicsOriginNames[static_cast<std::size_t>(origin)];
}

/// For people: "known dataset: TUM freiburg1 (by the name of the folder)".
[[nodiscard]] inline std::string text_of(const IntrinsicsNote& note) {
  std::string text(name_of(note.origin));
  std::ranges::replace(text, '_', ' ');
  return note.detail.empty() ? text : text + ": " + note.detail;
}

}  // namespace swiftlet
