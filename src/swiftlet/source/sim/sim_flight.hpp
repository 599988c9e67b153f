// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/sim/random/generated_scene.hpp"
#include "swiftlet/sim/scene.hpp"
#include "swiftlet/source/sim/sim_options.hpp"

namespace swiftlet {

/// What the address of a simulated rig stands for: the world, the rig, and where it truly was.
struct SimFlight {
  sim::Scene scene;
  SimOptions options;
  /// What is to be done there; random scenes alone have it.
  std::optional<sim::SceneTask> task;
  /// By camera of the rig: the one of the scene is what flies.
  std::vector<Transform<Camera, Camera>> T_flown_camera;

  /// Time since the scene's start at which an image was taken.
  [[nodiscard]] Nanoseconds flown(Stamp stamp) const {
    return options.start + Nanoseconds(stamp.ns);
  }
  /// Where a camera truly was, whatever the tracker said. REQUIRES: the rig has that camera.
  [[nodiscard]] Transform<World, Camera> true_pose(Stamp stamp, std::size_t camera) const;
};

/// Reads an address as open_sim_source() does. Errors: the same.
[[nodiscard]] Expected<SimFlight> read_sim_flight(std::string_view rest);

}  // namespace swiftlet
