// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/log_odds_scale.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/pipeline/config_fields.hpp"
#include "swiftlet/pipeline/lookahead.hpp"
#include "swiftlet/pipeline/new_world_rule.hpp"
#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/preprocess/frame_quality.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// The measurement model of the thesis, for its experiments and tables.
inline constexpr std::string_view kThesisModel = "inverse_sensor_model";

/// Every parameter of the mapper, with its default.
struct MapperConfig {
  RollingMap::Options map;                            ///< voxel size, window and trigger box
  NewWorldRule on_new_world = NewWorldRule::kRefuse;  ///< when the poses lose their place
  WindowOptions window;                               ///< where the window lies around the vehicle
  QualityLimits quality;                              ///< which images are not worth a fusion
  PreprocessOptions depth;                            ///< the steps, and their parameters
  SensorOptions sensor;                               ///< geometry and noise of the camera
  IntegrateOptions integrate;                         ///< how a frame is fused
  OccupancyThresholds occupancy;                      ///< where belief becomes a claim

  /// How the voxels of its map are read.
  [[nodiscard]] LogOddsScale scale() const { return {occupancy, integrate.logodds_per_step}; }

  /// The options of the depth steps, with the one that the measurement model wants behind the range
  /// gate.
  [[nodiscard]] PreprocessOptions preprocessing() const;

  /// All faults at once; empty if the config can be used. Each names its key.
  [[nodiscard]] std::vector<Error> faults() const;
};

}  // namespace swiftlet
