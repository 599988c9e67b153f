// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/commands/place_option.hpp"

#include <string_view>

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

CLI::Option* declare_place(CLI::App& parser, const std::string& name,
                           std::optional<Eigen::Vector3d>& place, const std::string& what) {
  const auto take = [&place, name](const std::string& text) {
    place = parse_place(text);
    if (!place)
      throw CLI::ValidationError(name, "'" + text + "' is no place: give x,y,z, as in 1,-2.5,1.2");
  };
  return parser.add_option_function<std::string>(name, take, what)->type_name("X,Y,Z");
}

}  // namespace swiftlet::app
