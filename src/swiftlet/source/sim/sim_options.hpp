// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/random/generated_scene.hpp"
#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/rig/rig_file.hpp"

namespace swiftlet {

/// What the address of a simulated rig asks for (see open_sim_source()).
struct SimOptions {
  std::optional<std::uint64_t> seed;  // of the noise, and of a random scene
  sim::RandomSceneOptions random;     // of a random scene
  std::string only_random{};          // an option that was given and only those have
  bool has_noise = true;
  bool has_drift = true;  // of the tracker
  Nanoseconds start{0};
  std::optional<std::size_t> frames;
  std::optional<double> rate_hz;  // of the depth camera, instead of the scene's
  std::optional<double> barrel;   // of the depth camera, instead of the scene's
  std::size_t cameras = 1;
  std::optional<std::uint64_t> shuffle;  // order of arrival within a period of the cameras
  std::optional<std::string> fault;
  Stamp fault_at{5'000'000'000};
  std::optional<RigDescription> rig_file;
  RigOptions rig;
};

/// Errors: kUsage for an option that is not known or cannot be meant; those of load_rig().
[[nodiscard]] Expected<SimOptions> parse_sim_options(const SourceAddress& address);

}  // namespace swiftlet
