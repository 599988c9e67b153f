// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/pose_sample.hpp"
#include "swiftlet/source/skipped_records.hpp"

namespace swiftlet {

/// The depth images of one camera of a recording, in the order of the recording.
class DepthStream {
 public:
  virtual ~DepthStream() = default;
  /// nullopt at the end. After an error the stream is at its end.
  [[nodiscard]] virtual Expected<std::optional<DepthFrame>> next() = 0;
  /// Images that could not be used and were left out since the last call.
  [[nodiscard]] virtual std::vector<SkippedImage> take_skipped() { return {}; }
};

/// The poses of a recording, in our axes, in the order of the recording.
class PoseStream {
 public:
  virtual ~PoseStream() = default;
  /// nullopt at the end. After an error the stream is at its end.
  [[nodiscard]] virtual Expected<std::optional<PoseSample>> next() = 0;
  /// Messages that are no poses and were left out since the last call, with file and place.
  [[nodiscard]] virtual std::vector<Error> take_skipped() { return {}; }
};

using DepthStreamPtr = std::unique_ptr<DepthStream>;
using PoseStreamPtr = std::unique_ptr<PoseStream>;

/// How the camera took an image, as far as the recording tells.
struct CaptureSettings {
  std::optional<double> exposure_us;
  std::optional<double> laser_mw;
};

}  // namespace swiftlet
