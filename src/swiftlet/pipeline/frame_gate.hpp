// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/pipeline/frame_verdict.hpp"
#include "swiftlet/preprocess/frame_quality.hpp"

namespace swiftlet {

/// Refuses depth images that are bad as a whole (method 8): no pixel of them is to be believed.
///
/// An image is frozen if it and more than max_frozen before it are repetitions, pixel by pixel on
/// every eighth row, of one image or of up to four in turn, while the pose has moved by 0.1 m or
/// 0.05 rad: noise alone changes every image of a
/// real camera, and one that stands still before a still world does no harm.
/// Real time: allocates nothing.
class FrameGate {
 public:
  explicit FrameGate(const QualityLimits& limits) : limits_(limits) {}

  /// nullopt for a frame that may be used. REQUIRES: the image has a pixel.
  [[nodiscard]] std::optional<FrameVerdict> refusal(const Frame& frame);

 private:
  static constexpr std::size_t kInTurn = 4;
  /// Images of a camera that repeat what it has shown before, by now.
  struct Run {
    std::array<std::uint64_t, kInTurn> hashes{};  // of the last that were new
    std::size_t next = 0;                         // place of the oldest
    int images = 0;                               // that repeat; 0: none has come
    Transform<World, Camera> T_world_camera;      // of the first
  };
  [[nodiscard]] bool is_frozen(const Frame& frame);

  QualityLimits limits_;
  std::array<Run, 256> runs_{};  // by camera
};

}  // namespace swiftlet
