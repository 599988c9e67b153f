// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/eval/camera/fill.hpp"
#include "swiftlet/eval/figure.hpp"

namespace swiftlet::eval {

/// The frames that share a setting.
struct FillMean {
  std::size_t frames = 0;  ///< images in it
  double valid = 0.0;      ///< sum over the images, see mean(); as in Fill
  double of_image = 0.0;   ///< likewise
  double of_middle = 0.0;  ///< likewise

  /// Adds the fill of one image.
  void add(const Fill& fill) {
    ++frames;
    valid += static_cast<double>(fill.valid);
    of_image += fill.of_image;
    of_middle += fill.of_middle;
  }
  /// A sum over the images as their mean. REQUIRES: frames > 0.
  [[nodiscard]] double mean(double sum) const { return sum / static_cast<double>(frames); }
};

/// Fill against one thing that was changed.
struct FillSweep {
  const char* name;                 ///< of its files and in JSON
  const char* title;                ///< of its column, with the unit
  std::map<double, FillMean> by{};  ///< means by the value that was set
};

/// Fill against each thing that a recording tells.
struct FillSweeps {
  std::size_t frames = 0;                              ///< images that were read
  FillSweep tilt{"tilt_deg", "tilt [deg]"};            ///< by the camera's pitch
  FillSweep exposure{"exposure_ms", "exposure [ms]"};  ///< by its exposure time
  FillSweep laser{"laser_mw", "laser power [mW]"};     ///< by the power of its projector

  /// Those of which more than nothing is known.
  [[nodiscard]] std::vector<const FillSweep*> known() const {
    std::vector<const FillSweep*> sweeps;
    for (const FillSweep* sweep : {&tilt, &exposure, &laser}) {
      if (!sweep->by.empty()) sweeps.push_back(sweep);
    }
    return sweeps;
  }
};

/// How many pixels of the images of some recordings have a reading, against the tilt of the wall
/// before the camera and, where they tell them, exposure and laser power.
/// Errors: those of the sources; kCorruptInput if they have no image, or images below 5 x 5 pixels.
[[nodiscard]] Expected<FillSweeps> measure_fill_sweeps(std::span<const std::string> addresses);

/// Share of valid pixels [%] against what was changed.
[[nodiscard]] Figure fill_figure(const FillSweep& sweep);

}  // namespace swiftlet::eval
