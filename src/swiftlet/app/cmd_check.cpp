// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <memory>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/config_file.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::app {
namespace {

Faults faults_in(const std::string& path) {
  const auto extension = std::filesystem::path(path).extension();
  if (extension != ".yaml" && extension != ".yml") return check_map(path);
  auto config = load_config({{path}, {}});
  return config ? Faults{} : std::move(config).error();
}

/// Fixes nothing. To find a fault is what the command is for and no wrong usage of it: exit code 1.
Faults check(const std::vector<std::string>& paths) {
  Faults all;
  for (const std::string& path : paths) {
    Faults faults = faults_in(path);
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
  parser.add_option("FILE", *paths, "map files (.swl) and config files (.yaml)")
      ->type_name("")
      ->required();
  parser.footer(
      "Examples:\n"
      "  swiftlet check flat.swl        every byte of a map, after a crash or a bad disk\n"
      "  swiftlet check flight.yaml     names, values and limits, with their lines\n"
      "Exit code 0 if all are good, 1 if any has a fault; every fault is listed.");
  return [paths] { return check(*paths); };
}

}  // namespace swiftlet::app
