// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "swiftlet/map/log_odds_scale.hpp"

namespace swiftlet {

/// What a whole map says of itself, in memory as in a file.
struct MapHeader {
  double voxel_m = 0.2;                      ///< edge of a voxel
  LogOddsScale scale{};                      ///< how its voxels are read
  std::uint64_t frame_count = 0;             ///< frames that it has seen; 0 if it does not tell
  std::optional<Eigen::Vector3d> start_m{};  ///< camera at the first frame [world], if it tells it
};

}  // namespace swiftlet
