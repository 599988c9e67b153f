// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/eval/camera/wall_noise.hpp"
#include "swiftlet/eval/figure.hpp"

namespace swiftlet::eval {

/// The walls of all frames, the camera that saw them, and its disparity error.
struct NoiseFit {
  std::vector<WallNoise> walls{};  ///< one a distance
  double focal_px = 0.0;           ///< of the camera
  double baseline_m = 0.0;         ///< of the stereo pair [m]
  double subpixel_px = 0.0;        ///< s of RMS = z^2 s / (f B)
};

/// How readings scatter about the walls of some recordings.
/// Errors: those of the sources; kCorruptInput if one shows no wall.
[[nodiscard]] Expected<NoiseFit> fit_noise(std::span<const std::string> addresses);

/// RMS [m] against distance [m]: the walls, and what the fit says of them.
[[nodiscard]] Figure noise_figure(const NoiseFit& fit);

}  // namespace swiftlet::eval
