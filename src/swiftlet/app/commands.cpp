// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <CLI/CLI.hpp>
#include <array>

#include "swiftlet/app/command.hpp"

// A subcommand is one file, which ends in declare_<name>(), and one line here.
#define SWIFTLET_COMMANDS(X)                                               \
  X(map, "build a map from a recorded or simulated flight")                \
  X(info, "tell what a map file or a recording (.bag, .mcap, .db3) holds") \
  X(doctor, "examine live cameras or a recording")                         \
  X(record, "record live RealSense cameras")                               \
  X(view, "show a map in the browser")                                     \
  X(render, "draw a map as a PNG picture")                                 \
  X(fly, "fly a simulated vehicle on nothing but its map")                 \
  X(plan, "find a path through a map")                                     \
  X(export, "write a map in another program's format")                     \
  X(compare, "count the voxels in which two maps differ")                  \
  X(bench, "measure how fast maps are built, beside OctoMap")              \
  X(score, "measure how right maps are, beside OctoMap")                   \
  X(experiment, "repeat the experiments of the thesis")                    \
  X(characterize, "measure noise and drop-outs of a camera")               \
  X(calibrate, "straighten the depths of a bent camera")                   \
  X(check, "look for faults in maps, configs, rigs, scenes")               \
  X(list, "list every source, method, format, view, parameter")

namespace swiftlet::app {

#define SWIFTLET_DECLARE(name, summary) Action declare_##name(CLI::App& parser);
SWIFTLET_COMMANDS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<DeclareCommand>> commands() {
#define SWIFTLET_LINE(name, summary) Registered<DeclareCommand>{#name, summary, declare_##name},
  static constexpr std::array kCommands{SWIFTLET_COMMANDS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kCommands;
}

}  // namespace swiftlet::app
