// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/condition/depth_step.hpp"
#include "swiftlet/condition/frame_quality.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// How the readings of a frame become evidence: as the thesis has it, or with readings that are
/// weighed against their neighbours first and thin things kept (docs/accuracy.md).
inline constexpr std::string_view kThesisFusion = "thesis";
inline constexpr std::string_view kSharpFusion = "sharp";
[[nodiscard]] constexpr bool is_fusion(std::string_view name) {
  return name == kThesisFusion || name == kSharpFusion;
}

/// Every parameter of the mapper, with its default.
struct MapperConfig {
  RollingMap::Options map;
  QualityLimits quality;
  ConditionOptions depth;
  SensorOptions sensor;
  IntegrateOptions integrate;
  OccupancyThresholds occupancy;

  /// The options of the depth steps, with those that the fusion adds behind the range gate.
  [[nodiscard]] ConditionOptions conditioning() const;

  /// All faults at once; empty if the config can be used. Each names its key.
  [[nodiscard]] std::vector<Error> faults() const;
};

/// A parameter's key in config files ("map.voxel_m": the unit is part of the name), what it means
/// and where it may lie.
struct ConfigField {
  std::string_view key;
  std::string_view meaning;
  double min = 0.0;  ///< both ends allowed; for numbers only
  double max = 0.0;
};

/// Calls visit(ConfigField, member&) for every parameter: the one list that the file reader, the
/// echo in the map, the documentation and the tests share. Members are double, int,
/// Eigen::Vector3d, std::string or a list of strings.
template <class Config, class Visit>
void visit_config(Config& c, Visit&& visit) {
  visit(ConfigField{"map.voxel_m", "edge of a cell", 0.005, 10.0}, c.map.voxel_m);
  visit(ConfigField{"map.size_m", "size of the window that follows the vehicle (x, y, z)", 0.005,
                    10000.0},
        c.map.size_m);
  visit(ConfigField{"map.trigger_m",
                    "how far the vehicle may leave the middle before the window moves (x, y, z)",
                    0.01, 1000.0},
        c.map.trigger_m);
  visit(ConfigField{"quality.min_valid", "frames with a smaller share of valid pixels are refused",
                    0.0, 1.0},
        c.quality.min_valid);
  visit(ConfigField{"quality.max_saturated",
                    "likewise with a larger share of readings at the end of the scale; 1: never",
                    0.0, 1.0},
        c.quality.max_saturated);
  visit(ConfigField{"quality.max_at_one_value",
                    "likewise with a larger share of readings of one value; 1: never", 0.0, 1.0},
        c.quality.max_at_one_value);
  visit(ConfigField{"quality.max_smeared",
                    "likewise with a larger share of blurred depth edges; 1: never", 0.0, 1.0},
        c.quality.max_smeared);
  visit(ConfigField{"quality.max_frozen",
                    "likewise after so many equal images from a camera that moves; 0: never", 0,
                    1000},
        c.quality.max_frozen);
  visit(ConfigField{"depth.steps", "conditioning steps, in order"}, c.depth.steps);
  visit(ConfigField{"depth.min_range_m", "nearer readings are dropped", 0.0, 100.0},
        c.depth.min_range_m);
  visit(ConfigField{"depth.max_range_m", "farther readings are dropped", 0.1, 100.0},
        c.depth.max_range_m);
  visit(ConfigField{"depth.downsample",
                    "n: every n x n pixels become their nearest reading; 1 keeps all", 1, 64},
        c.depth.downsample);
  visit(
      ConfigField{
          "distortion.x2_per_m",
          "depth error over X^2, X to the right of the optical axis; see `swiftlet calibrate`",
          -10.0, 10.0},
      c.depth.distortion.x2_per_m);
  visit(ConfigField{"distortion.y2_per_m", "depth error over Y^2, Y down", -10.0, 10.0},
        c.depth.distortion.y2_per_m);
  visit(ConfigField{"distortion.x1", "depth error over X", -1.0, 1.0}, c.depth.distortion.x1);
  visit(ConfigField{"distortion.y1", "depth error over Y", -1.0, 1.0}, c.depth.distortion.y1);
  visit(ConfigField{"distortion.offset_m", "depth error in the middle of the image", -1.0, 1.0},
        c.depth.distortion.offset_m);
  visit(ConfigField{"sensor.baseline_m", "distance of the stereo pair", 0.001, 10.0},
        c.sensor.baseline_m);
  visit(ConfigField{"sensor.subpixel_px",
                    "disparity error s; 0.05 well textured, above 0.2 needs calibration", 0.001,
                    10.0},
        c.sensor.subpixel_px);
  visit(ConfigField{"sensor.importance_m", "k of the inverse sensor model", 0.001, 10.0},
        c.sensor.model.importance_m);
  visit(ConfigField{"sensor.p_min", "occupancy of a cell that a ray passes", 0.01, 0.49},
        c.sensor.model.p_min);
  visit(ConfigField{"sensor.p_max", "highest occupancy that one reading can claim", 0.51, 0.999},
        c.sensor.model.p_max);
  visit(
      ConfigField{"integrate.integrator", "how a frame is fused (see `swiftlet list integrators`)"},
      c.integrate.integrator);
  visit(
      ConfigField{"integrate.fusion",
                  "thesis: the thesis's rule; sharp: noise is averaged, edges are dropped and thin "
                  "things kept first"},
      c.integrate.fusion);
  visit(ConfigField{"integrate.ray_method", "how rays are traced (see `swiftlet list rays`)"},
        c.integrate.ray_method);
  visit(ConfigField{"integrate.logodds_per_step", "one step of a cell's byte, in log-odds", 0.001,
                    1.0},
        c.integrate.logodds_per_step);
  visit(ConfigField{"integrate.threads", "threads that share a frame; the map is the same", 1, 64},
        c.integrate.threads);
  visit(ConfigField{"integrate.max_frame_ms",
                    "once fusing took so long, far blocks wait for the next frame; 0: never", 0.0,
                    1000.0},
        c.integrate.max_frame_ms);
  visit(
      ConfigField{"integrate.decay_s",
                  "in so many seconds an occupied cell becomes unknown where the camera looks and "
                  "sees nothing, not even a background; 0: never",
                  0.0, 3600.0},
      c.integrate.decay_s);
  visit(ConfigField{"occupancy.free_below", "cells below this byte are free", 1, 127},
        c.occupancy.free_below);
  visit(ConfigField{"occupancy.occupied_from", "cells from this byte on are occupied", 128, 255},
        c.occupancy.occupied_from);
}

}  // namespace swiftlet
