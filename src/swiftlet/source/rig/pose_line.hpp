// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "swiftlet/frame/pose_sample.hpp"
#include "swiftlet/source/rig/mounts.hpp"

namespace swiftlet {

/// What a pose line says of its column names.
inline constexpr std::string_view kPoseColumns = "stamp x y z qx qy qz qw [confidence]";

/// Reads "stamp x y z qx qy qz qw [confidence]": seconds, metres, scalar last (as in TUM's
/// trajectories); confidence 0 to 3, 3 if left out. NaN passes: the gates count it. The sample is
/// of an unspecified clock.
/// Errors: kCorruptInput: another number of columns, no number, a time before 1970.
[[nodiscard]] Expected<PoseSample> parse_pose_line(std::string_view line,
                                                   BodyAxes axes = BodyAxes::kRep103);
/// The same of its words.
[[nodiscard]] Expected<PoseSample> parse_pose_words(std::span<const std::string_view> words,
                                                    BodyAxes axes);

/// The line that parse_pose_line() reads as the same sample, bit for bit; without a line end.
/// REQUIRES: a time since 1970.
[[nodiscard]] std::string pose_line(const PoseSample& pose);

}  // namespace swiftlet
