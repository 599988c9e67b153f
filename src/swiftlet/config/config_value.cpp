// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/config/config_value_private.hpp"

namespace swiftlet {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array kLengths{Unit{"mm", 1e-3}, Unit{"cm", 1e-2}, Unit{"m", 1.0}, Unit{"km", 1e3}};

/// What to write instead: "20cm" under a key in metres wants "0.2".
std::string remedy(std::string_view key, std::string_view text) {
  if (!key.ends_with("_m")) return "write a plain number";
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const Unit& length : kLengths) {
    if (error == std::errc{} && unit == length.name) {
      return fmt::format("the key says metres: write {:g}", value * length.metres);
    }
  }
  return "write a plain number of metres";
}

std::string kind_of(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a group of keys" : "nothing";
}

template <class Number>
Status read_number(std::string_view key, const YAML::Node& node, std::string_view wanted,
                   Number& out) {
  const std::string text = node.IsScalar() ? node.Scalar() : std::string{};
  const auto value = number_from<Number>(text);
  if (!value) {
    return fail(ErrorCode::kInvalidConfig, {}, fmt::format("{} is not {}", kind_of(node), wanted),
                remedy(key, text));
  }
  out = *value;
  return Done{};
}

}  // namespace

Status read_value(std::string_view key, const YAML::Node& node, double& out) {
  return read_number(key, node, "a number", out);
}

Status read_value(std::string_view key, const YAML::Node& node, int& out) {
  return read_number(key, node, "a whole number", out);
}

Status read_value(std::string_view, const YAML::Node& node, std::string& out) {
  if (!node.IsScalar()) {
    return fail(ErrorCode::kInvalidConfig, {}, kind_of(node) + " is not a name", "write one name");
  }
  out = node.Scalar();
  return Done{};
}

Status read_value(std::string_view key, const YAML::Node& node, NewWorldRule& out) {
  std::string name;
  if (auto read = read_value(key, node, name); !read) return read;
  const auto rule = new_world_rule(name);
  if (!rule) {
    return fail(ErrorCode::kInvalidConfig, {}, fmt::format("unknown rule '{}'", name),
                fmt::format("known are: {}", fmt::join(kNewWorldRuleNames, ", ")));
  }
  out = *rule;
  return Done{};
}

Status read_value(std::string_view key, const YAML::Node& node, Eigen::Vector3d& out) {
  if (node.IsScalar()) {
    double all = 0.0;
    auto read = read_value(key, node, all);
    if (read) out.setConstant(all);
    return read;
  }
  if (!node.IsSequence() || node.size() != 3) {
    return fail(ErrorCode::kInvalidConfig, {}, "this is not three numbers",
                "write [x, y, z], or one number for all three");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto read = read_value(key, node[axis], out[static_cast<Eigen::Index>(axis)]);
    if (!read) return read;
  }
  return Done{};
}

Status read_value(std::string_view key, const YAML::Node& node, std::vector<std::string>& out) {
  if (!node.IsSequence()) {
    return fail(ErrorCode::kInvalidConfig, {}, kind_of(node) + " is not a list of names",
                "write [first, second]");
  }
  out.clear();
  for (const YAML::Node& item : node) {
    if (auto read = read_value(key, item, out.emplace_back()); !read) return read;
  }
  return Done{};
}

// fmt's {} is the shortest text that reads back to the same double.
std::string value_text(double value) { return fmt::format("{}", value); }
std::string value_text(int value) { return fmt::format("{}", value); }
std::string value_text(const std::string& value) { return value; }
std::string value_text(NewWorldRule value) { return std::string(name_of(value)); }
std::string value_text(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}
std::string value_text(const std::vector<std::string>& value) {
  return fmt::format("[{}]", fmt::join(value, ", "));
}

}  // namespace swiftlet
