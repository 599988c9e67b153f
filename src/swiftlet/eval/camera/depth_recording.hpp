// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "swiftlet/source/streams.hpp"

namespace swiftlet::eval {

/// Depth images without poses: what a camera on a tripod records, and what it is calibrated with.
struct DepthRecording {
  DepthStreamPtr stream;
  std::optional<double> baseline_m;
  std::vector<CaptureSettings> settings{};  ///< of each image; empty where nothing is known
};

/// Opens any source for its depth images alone. A bag needs no poses for that: `bag:depth.bag`,
/// with the options depth_topic, info_topic and depth_unit_m. Errors: those of open_source() and of
/// the bag.
[[nodiscard]] Expected<DepthRecording> open_depth_recording(std::string_view address);

}  // namespace swiftlet::eval
