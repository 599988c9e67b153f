// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/commands/config_flags.hpp"

namespace swiftlet::app {

void declare_config_flags(CLI::App& parser, ConfigInput& config) {
  parser.add_option("--config", config.files, "parameters, as a YAML file; of several, later wins")
      ->type_name("FILE")
      ->allow_extra_args(false);
  parser.add_option("--set", config.settings, "one parameter, as in map.voxel_m=0.1")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace swiftlet::app
