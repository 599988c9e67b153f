// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "swiftlet/app/checked_files.hpp"
#include "swiftlet/app/command.hpp"
#include "swiftlet/store/salvage.hpp"

namespace swiftlet::app {
namespace {

/// To find a fault is what the command is for and no wrong usage of it: exit code 1.
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

struct CheckOptions {
  std::vector<std::string> paths;
  bool is_repair = false;
  std::string out;
};

/// The map that is damaged stays as it is: what can be read of it becomes a new one.
Faults repair(const CheckOptions& options) {
  if (options.paths.size() != 1) {
    return {{ErrorCode::kUsage, "check", "--repair takes one map", "repair one after the other"}};
  }
  if (options.out.empty()) {
    return {{ErrorCode::kUsage, "check", "--repair needs -o FILE for the new map", {}}};
  }
  auto report = salvage_map(options.paths.front(), options.out);
  if (!report) return fault_of(std::move(report));
  for (const std::string& line : report->lines()) fmt::print("{}\n", line);
  fmt::print("{}\n", options.out);
  return faults_in_file(options.out);
}

}  // namespace

Action declare_check(CLI::App& parser) {
  auto o = std::make_shared<CheckOptions>();
  parser.add_option("FILE", o->paths, "maps (.swl, .bt, .ot), bags, configs, rigs, scenes")
      ->type_name("")
      ->required();
  parser.add_flag("--repair", o->is_repair,
                  "write what is sound of a damaged map as a new one, see -o");
  parser.add_option("-o,--out", o->out, "the new map")->type_name("FILE");
  parser.footer(
      "Examples:\n"
      "  swiftlet check flat.swl        every byte of a map, after a crash or a bad disk\n"
      "  swiftlet check flight.yaml     a config, a rig or a scene: names, values, limits, lines\n"
      "  swiftlet check flat.swl --repair -o clean.swl\n"
      "Files are known by their content, not by their name.\n"
      "Exit code 0 if all are good, 1 if any has a fault; every fault is listed.");
  return [o]() -> Faults {
    if (o->is_repair) return repair(*o);
    if (o->out.empty()) return check(o->paths);
    return {{ErrorCode::kUsage, "check", "-o goes with --repair", "check alone writes nothing"}};
  };
}

}  // namespace swiftlet::app
