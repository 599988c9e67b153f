// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/report/checked_files.hpp"
#include "swiftlet/app/report/map_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/store/map_file/salvage.hpp"

namespace swiftlet::app {
namespace {

struct CheckOptions {
  std::vector<std::string> paths;
  bool is_repair = false;
  bool as_json = false;
  std::string out;
};

struct CheckedFile {
  std::string path;
  Faults faults;
};

/// To find a fault is what the command is for and no wrong usage of it: exit code 1.
CheckedFile checked(const std::string& path) {
  CheckedFile file{path, faults_in_file(path)};
  for (Error& fault : file.faults) {
    fault.code = ErrorCode::kCorruptInput;
    if (fault.where.empty()) fault.where = path;
  }
  return file;
}

nlohmann::ordered_json file_json(const CheckedFile& file) {
  nlohmann::ordered_json json{{"path", file.path},
                              {"is_good", file.faults.empty()},
                              {"findings", nlohmann::ordered_json::array()}};
  for (const Error& fault : file.faults) {
    json["findings"].push_back({{"severity", "fault"},
                                {"where", fault.where},
                                {"what", fault.what},
                                {"remedy", fault.remedy}});
  }
  return json;
}

nlohmann::ordered_json files_json(const std::vector<CheckedFile>& files) {
  nlohmann::ordered_json json{{"faults", 0}, {"files", nlohmann::ordered_json::array()}};
  std::size_t faults = 0;
  for (const CheckedFile& file : files) {
    faults += file.faults.size();
    json["files"].push_back(file_json(file));
  }
  json["faults"] = faults;
  return json;
}

Faults check(const CheckOptions& options) {
  std::vector<CheckedFile> files;
  Faults all;
  for (const std::string& path : options.paths) {
    files.push_back(checked(path));
    const Faults& faults = files.back().faults;
    if (faults.empty() && !options.as_json) fmt::print("{}: good\n", path);
    all.insert(all.end(), faults.begin(), faults.end());
  }
  if (options.as_json) fmt::print("{}\n", json_text(files_json(files)));
  return all;
}

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
  const CheckedFile repaired = checked(options.out);
  if (options.as_json) {
    auto json = files_json({repaired});
    json["salvage"] = salvage_json(*report);
    fmt::print("{}\n", json_text(json));
    return repaired.faults;
  }
  for (const std::string& line : report->lines()) fmt::print("{}\n", line);
  fmt::print("{}\n", options.out);
  return repaired.faults;
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
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet check flat.swl        every byte of a map, after a crash or a bad disk\n"
      "  swiftlet check flight.yaml     a config, a rig or a scene: names, values, limits, lines\n"
      "  swiftlet check flat.swl --repair -o clean.swl\n"
      "  swiftlet check *.swl --json | jq '.files[] | select(.is_good | not)'\n"
      "Files are known by their content, not by their name.\n"
      "Exit code 0 if all are good, 1 if any has a fault; every fault is listed.");
  return [o]() -> Faults {
    if (o->is_repair) return repair(*o);
    if (o->out.empty()) return check(*o);
    return {{ErrorCode::kUsage, "check", "-o goes with --repair", "check alone writes nothing"}};
  };
}

}  // namespace swiftlet::app
