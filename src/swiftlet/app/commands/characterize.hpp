// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <vector>

#include "swiftlet/app/command.hpp"

namespace swiftlet::app {

/// What `swiftlet characterize` is asked for.
struct CharacterizeOptions {
  std::string what;                  ///< "noise" or "fill"
  std::vector<std::string> sources;  ///< addresses
  std::string out;                   ///< folder for figures; empty for none
  bool as_json = false;
};

/// How readings scatter about a wall: fits the disparity error.
[[nodiscard]] Faults characterize_noise(const CharacterizeOptions& options);

/// How many pixels have a reading, against exposure, laser power and tilt.
[[nodiscard]] Faults characterize_fill(const CharacterizeOptions& options);

}  // namespace swiftlet::app
