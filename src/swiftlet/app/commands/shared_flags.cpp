// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/commands/shared_flags.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string_view>
#include <utility>

#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/base/number_text.hpp"

namespace swiftlet::app {
namespace {

std::optional<Eigen::Vector3d> parse_place(std::string_view text) {
  Eigen::Vector3d place;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (axis == 2)) return std::nullopt;
    const auto value = parse_number(text.substr(0, comma));
    if (!value) return std::nullopt;
    place[axis] = *value;
    if (axis < 2) text.remove_prefix(comma + 1);
  }
  return place;
}

}  // namespace

void declare_config_flags(CLI::App& parser, ConfigInput& config) {
  parser.add_option("--config", config.files, "parameters, as a YAML file; of several, later wins")
      ->type_name("FILE")
      ->allow_extra_args(false);
  parser.add_option("--set", config.settings, "one parameter, as in map.voxel_m=0.1")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::Option* declare_place(CLI::App& parser, const std::string& name,
                           std::optional<Eigen::Vector3d>& place, const std::string& what) {
  const auto take = [&place, name](const std::string& text) {
    place = parse_place(text);
    if (!place)
      throw CLI::ValidationError(name, "'" + text + "' is no place: give x,y,z, as in 1,-2.5,1.2");
  };
  return parser.add_option_function<std::string>(name, take, what)->type_name("X,Y,Z");
}

void declare_salvage(CLI::App& parser, bool& is_salvaged) {
  parser.add_flag("--salvage", is_salvaged, "read what is sound of a damaged map, tell the rest");
}

Expected<OpenedMap> open_and_tell(const std::string& path, bool is_salvaged) {
  auto opened = open_map(path, is_salvaged);
  if (!opened || !opened->salvage || opened->salvage->is_whole()) return opened;
  for (const std::string& line : opened->salvage->lines())
    std::fputs((visible("swiftlet: " + path + ": " + line) + "\n").c_str(), stderr);
  return opened;
}

Expected<BlockMap> read_and_tell(const std::string& path, bool is_salvaged) {
  auto opened = open_and_tell(path, is_salvaged);
  if (!opened) return forward_error(std::move(opened));
  return read_whole_map(opened->file);
}

}  // namespace swiftlet::app
