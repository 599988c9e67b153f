// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig/rig.hpp"

namespace swiftlet {

/// What whoever looks at a map should know of where it comes from, a sentence each: what was chosen
/// of a recording, whose intrinsics changed, which camera fell silent, whose clock was set.
[[nodiscard]] std::vector<std::string> source_notes(const FrameSource& source);

/// "the clock of the poses was set back 1 time, by 30.0 s" and the like; none if it never was.
[[nodiscard]] std::vector<std::string> clock_notes(const FrameTally& tally);
/// "camera 'left': no image after 3.40 s of 10.00"; none if all went on to the end.
[[nodiscard]] std::vector<std::string> silence_notes(const RigStatistics& facts,
                                                     const RigOptions& rig);
/// "camera 'front': its intrinsics changed 1 time, ..."; none if they did not.
[[nodiscard]] std::vector<std::string> intrinsics_notes(const RigStatistics& facts,
                                                        const RigOptions& rig);

/// "1 time", "3 times"
[[nodiscard]] std::string times_text(std::size_t count);

}  // namespace swiftlet
