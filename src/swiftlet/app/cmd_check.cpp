// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "swiftlet/app/checked_files.hpp"
#include "swiftlet/app/command.hpp"

namespace swiftlet::app {
namespace {

/// Fixes nothing. To find a fault is what the command is for and no wrong usage of it: exit code 1.
Faults check(const std::vector<std::string>& paths) {
  Faults all;
  for (const std::string& path : paths) {
    Faults faults = faults_in_file(path);
    if (faults.empty()) fmt::print("{}: good\n", path);
    for (Error& fault : faults) {
      fault.code = ErrorCode::kCorruptInput;
      if (fault.where.empty()) fault.where = path;
    }
    std::ranges::move(faults, std::back_inserter(all));
  }
  return all;
}

}  // namespace

Action declare_check(CLI::App& parser) {
  auto paths = std::make_shared<std::vector<std::string>>();
  parser.add_option("FILE", *paths, "maps (.swl, .bt, .ot), bags, configs, rigs, scenes")
      ->type_name("")
      ->required();
  parser.footer(
      "Examples:\n"
      "  swiftlet check flat.swl        every byte of a map, after a crash or a bad disk\n"
      "  swiftlet check flight.yaml     a config, a rig or a scene: names, values, limits, lines\n"
      "Files are known by their content, not by their name.\n"
      "Exit code 0 if all are good, 1 if any has a fault; every fault is listed.");
  return [paths] { return check(*paths); };
}

}  // namespace swiftlet::app
