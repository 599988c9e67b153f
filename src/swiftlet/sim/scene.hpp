// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "swiftlet/base/angle.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/sim/flight.hpp"
#include "swiftlet/sim/triangle_mesh.hpp"

namespace swiftlet::sim {

/// What a surface gives a stereo matcher to hold on to.
struct Material {
  std::string name;
  double texture = 1.0;  ///< 0 blank wall or glass .. 1 richly textured
};

struct Box {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d size_m;
  Eigen::Quaterniond R_world_box = Eigen::Quaterniond::Identity();
};

struct Cylinder {
  Eigen::Vector3d from_m, to_m;  ///< centres of its two ends
  double diameter_m;
};

/// A square sheet; large enough, it passes for a plane without end.
struct Plane {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d normal;
  double side_m = 200.0;
};

struct Object {
  std::string name;
  std::variant<Box, Cylinder, Plane, TriangleMesh> shape;
  std::uint16_t material = 0;  ///< index into Scene::materials
};

/// Objects that travel together; their coordinates are relative to the point that moves.
struct Mover {
  std::string name;
  std::vector<Object> objects;
  Flight path;
};

/// A stereo depth camera; the defaults are a RealSense D435 at 848 x 480 (method 1 and 3).
struct StereoOptions {
  int width = 848;
  int height = 480;
  double hfov_rad = radians(91.2);
  double baseline_m = 0.050;
  double rate_hz = 30.0;
  double min_range_m = 0.2;
  double max_range_m = 16.0;         ///< useful range; the device returns values up to 65 m
  double disparity_noise_px = 0.08;  ///< standard deviation
  double disparity_step_px = 1.0 / 32.0;
  double mixed_pixel_chance = 0.3;  ///< of a pixel at a depth edge to fall in between
  /// By what share the depth at the left and right edge of the image is too large at 1.4 m: the
  /// imagers do not stand as they should. It is an error of disparity that grows with the square of
  /// the distance from the optical axis, so that of depth grows with depth (method 9).
  double barrel = 0.0;
  bool is_ideal = false;  ///< exact depth everywhere: no noise, shadow or drop-out
};

/// A tracking camera; the defaults are a RealSense T265 in a good room.
struct TrackerOptions {
  double rate_hz = 200.0;
  double position_noise_m = 0.0005;
  double attitude_noise_rad = radians(0.03);
  double drift_m_per_sqrt_s = 0.001;                ///< random walk along each axis
  double yaw_drift_rad_per_sqrt_s = radians(0.01);  ///< gravity holds roll and pitch
  double medium_after_s = 0.15;                     ///< confidence 1 before, 2 from here on
  double high_after_s = 0.5;                        ///< confidence 3 from here on
  double nan_chance = 0.0;                          ///< of a sample to be all NaN

  /// It recognises a place and corrects itself at once.
  struct Jump {
    double at_s = 0.0;
    Eigen::Vector3d by_m = Eigen::Vector3d::Zero();
    double yaw_rad = 0.0;
  };
  std::optional<Jump> jump;
};

/// Takes all faults from the instruments: exact depth, exact poses, trusted from the start.
void make_ideal(StereoOptions& camera, TrackerOptions& tracker);

/// Where the depth camera sits on the tracking camera. The default is about that of Intel's printed
/// bracket, not quite straight, as in life.
[[nodiscard]] Transform<Body, Camera> mount_from(const Eigen::Vector3d& at_m,
                                                 const Eigen::Quaterniond& R_body_flyer);
[[nodiscard]] Transform<Body, Camera> default_mount();

/// A world, a rig, and the way the rig takes through it. World frame: x forward, y left, z up,
/// metres. The flight is that of the depth camera, seen as x forward, y left, z up.
struct Scene {
  std::string name;
  std::string about;
  std::uint64_t seed = 1;
  std::vector<Material> materials{{"default", 1.0}};
  std::vector<Object> objects;
  std::vector<Mover> movers;
  StereoOptions camera;
  TrackerOptions tracker;
  Transform<Body, Camera> T_body_camera = default_mount();
  Flight flight;
};

}  // namespace swiftlet::sim
