// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are the YAML of a config (also the one in a map), of a rig and of a scene. No input may
// crash, hang, or take more memory than the limits of parse_yaml(). A config that is read can be
// written, and read as the same.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "swiftlet/config/config_file.hpp"
#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/source/rig/rig_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto config = parse_config(text, "f.yaml")) {
    const std::string written = config_to_yaml(config->mapper);
    const auto again = parse_config(written, "g.yaml");
    if (!again || config_to_yaml(again->mapper) != written) std::abort();
  }
  (void)parse_rig(text, "f.yaml");
  // Meshes are other files, which ply_fuzz reads.
  if (text.find("file") == std::string::npos) (void)sim::parse_scene(text, "f.yaml");
  return 0;
}
