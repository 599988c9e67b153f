// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace swiftlet {

/// What became of a frame. Refused frames leave the map as it was.
enum class FrameVerdict : std::uint8_t {
  kIntegrated,
  kNoReadings,      ///< no valid pixel within range
  kSizeMismatch,    ///< the image is not of the size that its intrinsics speak of
  kPoseOutOfRange,  ///< farther than 1000 km from the origin
  kMostlyEmpty,     ///< hardly any pixel has a reading (quality.min_valid)
  kSaturated,       ///< most readings are at the end of the scale, or of one value
  kSmeared,         ///< most depth edges are drawn out: moved during the exposure
  kFrozen,          ///< the camera moves and its image does not
  kOtherWorld,      ///< its poses and the map share no world (map.on_new_world)
  kNoise,           ///< hardly two neighbours agree: no surface looks so
};
/// For people and machines, by FrameVerdict.
inline constexpr std::array<std::string_view, 10> kFrameVerdictNames{
    "integrated", "no_readings", "size_mismatch", "pose_out_of_range", "mostly_empty",
    "saturated",  "smeared",     "frozen",        "other_world",       "noise"};

}  // namespace swiftlet
