// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <vector>

#include "swiftlet/sim/scene.hpp"
#include "swiftlet/sim/yaml_section_private.hpp"

namespace swiftlet::sim {

// The sections of a scene file, one reader each. Absent sections leave the defaults of scene.hpp;
// whatever is wrong goes to the section's YamlProblem.

void read_camera(YamlSection& scene, StereoOptions& camera);
void read_mount(YamlSection& scene, Transform<Body, Camera>& T_body_camera);
void read_tracker(YamlSection& scene, TrackerOptions& tracker);
void read_materials(YamlSection& scene, std::vector<Material>& materials);
/// Waypoints come with their own time for a leg (`leg_s`), or get one from speed and turn rate.
[[nodiscard]] Flight read_flight(YamlSection& parent, std::string_view key);

/// Reads the lists `boxes`, `cylinders`, `planes` and `meshes` of a scene or a mover.
struct ObjectReader {
  const std::vector<Material>& materials;
  std::string folder;         ///< where the paths of meshes start
  std::size_t triangles = 0;  ///< of all that was read; ends the reading above kMaxTriangles

  [[nodiscard]] std::vector<Object> read(YamlSection& parent);
};

}  // namespace swiftlet::sim
