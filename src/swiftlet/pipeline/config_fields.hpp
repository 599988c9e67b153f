// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string_view>

namespace swiftlet {

/// A parameter's key in config files ("map.voxel_m": the unit is part of the name), what it means
/// and where it may lie.
struct ConfigField {
  std::string_view key;
  std::string_view meaning;
  double min = 0.0;  ///< both ends allowed; for numbers only
  double max = 0.0;
};

/// The parameters of each section, for visit_config().
namespace config_fields {

template <class Options, class Visit>
void map(Options& o, Visit& visit) {
  visit(ConfigField{"map.voxel_m", "edge of a voxel", 0.005, 10.0}, o.voxel_m);
  visit(ConfigField{"map.size_m", "size of the window that follows the vehicle (x, y, z)", 0.005,
                    10000.0},
        o.size_m);
  visit(
      ConfigField{
          "map.trigger_m",
          "how far the vehicle may leave the middle before the window moves (x, y, z); at most "
          "half of map.size_m",
          0.01, 1000.0},
      o.trigger_m);
}

template <class Rule, class Visit>
void new_world(Rule& rule, Visit& visit) {
  visit(ConfigField{"map.on_new_world",
                    "when the poses lose their place: refuse frames until the map is begun anew "
                    "(`swiftlet map` does, in a file of its own), clear the map, or keep mapping "
                    "into it"},
        rule);
}

template <class Options, class Visit>
void window(Options& o, Visit& visit) {
  visit(
      ConfigField{"map.lookahead_s",
                  "the window's middle is where the vehicle will be by then, at most a quarter of "
                  "the window ahead; 0: at the vehicle",
                  0.0, 10.0},
      o.lookahead_s);
}

template <class Options, class Visit>
void quality(Options& o, Visit& visit) {
  visit(ConfigField{"quality.min_valid", "frames with a smaller share of valid pixels are refused",
                    0.0, 1.0},
        o.min_valid);
  visit(ConfigField{"quality.max_saturated",
                    "likewise with a larger share of readings at the end of the scale; 1: never",
                    0.0, 1.0},
        o.max_saturated);
  visit(ConfigField{"quality.max_at_one_value",
                    "likewise with a larger share of readings of one value; 1: never", 0.0, 1.0},
        o.max_at_one_value);
  visit(ConfigField{"quality.max_smeared",
                    "likewise with a larger share of blurred depth edges; 1: never", 0.0, 1.0},
        o.max_smeared);
  visit(ConfigField{"quality.max_rough",
                    "likewise with a larger share of neighbours that no surface has; 1: never", 0.0,
                    1.0},
        o.max_rough);
  visit(ConfigField{"quality.max_frozen",
                    "likewise after so many equal images from a camera that moves; 0: never", 0,
                    1000},
        o.max_frozen);
}

template <class Options, class Visit>
void depth(Options& o, Visit& visit) {
  visit(ConfigField{"depth.steps", "preprocessing steps, in order"}, o.steps);
  visit(ConfigField{"depth.min_range_m", "nearer readings are dropped", 0.0, 100.0}, o.min_range_m);
  visit(ConfigField{"depth.max_range_m", "farther readings are dropped", 0.1, 100.0},
        o.max_range_m);
  visit(ConfigField{"depth.downsample",
                    "n: every n x n pixels become their nearest reading; 1 keeps all", 1, 64},
        o.downsample);
}

template <class Options, class Visit>
void distortion(Options& o, Visit& visit) {
  visit(
      ConfigField{
          "distortion.x2_per_m",
          "depth error over X^2, X to the right of the optical axis; see `swiftlet calibrate`",
          -10.0, 10.0},
      o.x2_per_m);
  visit(ConfigField{"distortion.y2_per_m", "depth error over Y^2, Y down", -10.0, 10.0},
        o.y2_per_m);
  visit(ConfigField{"distortion.x1", "depth error over X", -1.0, 1.0}, o.x1);
  visit(ConfigField{"distortion.y1", "depth error over Y", -1.0, 1.0}, o.y1);
  visit(ConfigField{"distortion.offset_m", "depth error in the middle of the image", -1.0, 1.0},
        o.offset_m);
}

template <class Options, class Visit>
void sensor(Options& o, Visit& visit) {
  visit(ConfigField{"sensor.baseline_m", "distance of the stereo pair", 0.001, 10.0}, o.baseline_m);
  visit(ConfigField{"sensor.subpixel_px",
                    "disparity error s; 0.05 well textured, above 0.2 needs calibration", 0.001,
                    10.0},
        o.subpixel_px);
  visit(ConfigField{"sensor.importance_m", "k of the inverse sensor model", 0.001, 10.0},
        o.model.importance_m);
  visit(ConfigField{"sensor.p_min", "occupancy of a voxel that a ray passes", 0.01, 0.49},
        o.model.p_min);
  visit(ConfigField{"sensor.p_max",
                    "highest occupancy that one reading can claim; of the inverse sensor model",
                    0.51, 0.999},
        o.model.p_max);
}

template <class Options, class Visit>
void integrate(Options& o, Visit& visit) {
  visit(
      ConfigField{"integrate.integrator", "how a frame is fused (see `swiftlet list integrators`)"},
      o.integrator);
  visit(ConfigField{"integrate.model",
                    "how readings become evidence: inverse_sensor_model, thin_obstacle_preserving "
                    "or precision_weighted (see `swiftlet list models`)"},
        o.model);
  visit(ConfigField{"integrate.ray_method", "how rays are traced (see `swiftlet list rays`)"},
        o.ray_method);
  visit(ConfigField{"integrate.logodds_per_step", "one step of a voxel's byte, in log-odds", 0.001,
                    1.0},
        o.logodds_per_step);
  visit(ConfigField{"integrate.threads", "threads that share a frame; the map is the same", 1, 64},
        o.threads);
  visit(
      ConfigField{
          "integrate.max_frame_ms",
          "once fusing took so long, far blocks are left out of a frame and counted; 0: never", 0.0,
          1000.0},
      o.max_frame_ms);
  visit(
      ConfigField{"integrate.decay_s",
                  "in so many seconds an occupied voxel becomes unknown where the camera looks and "
                  "sees nothing, not even a background; 0: never",
                  0.0, 3600.0},
      o.decay_s);
}

template <class Options, class Visit>
void occupancy(Options& o, Visit& visit) {
  visit(ConfigField{"occupancy.free_below", "voxels below this byte are free", 1, 127},
        o.free_below);
  visit(ConfigField{"occupancy.occupied_from", "voxels from this byte on are occupied", 128, 255},
        o.occupied_from);
}

}  // namespace config_fields

/// Calls visit(ConfigField, member&) for every parameter: the one list that the file reader, the
/// echo in the map, the documentation and the tests share. Members are double, int,
/// Eigen::Vector3d, NewWorldRule, std::string or a list of strings.
template <class Config, class Visit>
void visit_config(Config& c, Visit&& visit) {
  config_fields::map(c.map, visit);
  config_fields::new_world(c.on_new_world, visit);
  config_fields::window(c.window, visit);
  config_fields::quality(c.quality, visit);
  config_fields::depth(c.depth, visit);
  config_fields::distortion(c.depth.distortion, visit);
  config_fields::sensor(c.sensor, visit);
  config_fields::integrate(c.integrate, visit);
  config_fields::occupancy(c.occupancy, visit);
}

}  // namespace swiftlet
