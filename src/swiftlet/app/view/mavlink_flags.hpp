// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "swiftlet/mavlink/companion/autopilot.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"
#include "swiftlet/source/rig/rig.hpp"

namespace swiftlet::app {

/// What a user may say of the autopilot (docs/autopilot.md).
struct MavlinkFlags {
  std::vector<std::string> links;  ///< none: no autopilot
  std::string key_file;
  std::string poses = "none";

  [[nodiscard]] bool is_wanted() const { return !links.empty(); }
};

/// Declares --mavlink, --mavlink-key and --mavlink-poses.
void declare_mavlink_flags(CLI::App& parser, MavlinkFlags& flags);

/// Links, key and what is told. The range of obstacles is that of the map's window, the height and
/// radius of the vehicle are those of the rig's body box, if it has one (`rig` may be null).
/// Errors: kUsage for a link that cannot be meant; those of load_signing_key().
[[nodiscard]] Expected<mavlink::AutopilotOptions> autopilot_options(const MavlinkFlags& flags,
                                                                    const MapperConfig& config,
                                                                    const RigOptions* rig);

}  // namespace swiftlet::app
