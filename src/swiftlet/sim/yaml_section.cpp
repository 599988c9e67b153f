// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/sim/yaml_section_private.hpp"

namespace swiftlet::sim {
namespace {

std::string allowed(const Limits& limits) {
  if (std::isfinite(limits.high)) {
    return fmt::format("{} {} to {}", limits.low_is_allowed ? "from" : "greater than", limits.low,
                       limits.high);
  }
  if (std::isfinite(limits.low))
    return fmt::format("{} {}", limits.low_is_allowed ? "at least" : "greater than", limits.low);
  return "any finite number";
}

/// Not yaml-cpp's own conversion, which follows the locale of the host program; with YAML's words
/// for what is no number or has no end, so that these can be refused by their name.
std::optional<double> yaml_number(std::string_view text) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::nan("");
  std::string_view word = text;
  const bool is_negative = word.starts_with('-');
  if (is_negative || word.starts_with('+')) word.remove_prefix(1);
  if (word == ".inf" || word == ".Inf" || word == ".INF") return is_negative ? -kEndless : kEndless;
  return parse_number(text);
}

}  // namespace

void YamlProblem::add(const YAML::Mark& mark, std::string what, std::string remedy) {
  if (first) return;
  const std::string where = mark.is_null() ? file : fmt::format("{}:{}", file, mark.line + 1);
  first = Error{ErrorCode::kInvalidConfig, where, std::move(what), std::move(remedy)};
}

YamlSection::YamlSection(const YAML::Node& node, std::string title, YamlProblem& problem)
    : node_(node), title_(std::move(title)), problem_(&problem) {
  if (!node_.IsMap()) this->problem(fmt::format("{} must be a mapping of keys to values", title_));
}

void YamlSection::problem(std::string what, std::string remedy) {
  problem_->add(node_.Mark(), std::move(what), std::move(remedy));
}

YAML::Node YamlSection::find(std::string_view key) {
  known_.emplace_back(key);
  if (!node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  for (const auto& entry : node_)
    if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
  return YAML::Node(YAML::NodeType::Undefined);
}

YAML::Node YamlSection::require(std::string_view key, bool is_optional) {
  const YAML::Node node = find(key);
  const bool is_missing = node.Type() == YAML::NodeType::Undefined;
  if (is_missing && !is_optional) problem(fmt::format("{} lacks the key '{}'", title_, key));
  return node;
}

bool YamlSection::has(std::string_view key) {
  return find(key).Type() != YAML::NodeType::Undefined;
}

double YamlSection::scalar(const YAML::Node& node, std::string_view key, const Limits& limits) {
  const auto number = node.IsScalar() ? yaml_number(node.Scalar()) : std::nullopt;
  const double value = number.value_or(0.0);
  if (!number) {
    problem_->add(node.Mark(), fmt::format("'{}' of {} must be a number", key, title_));
    return 0.0;
  }
  const bool is_low = limits.low_is_allowed ? value < limits.low : value <= limits.low;
  if (!std::isfinite(value) || is_low || value > limits.high) {
    problem_->add(node.Mark(), fmt::format("'{}' of {} cannot be {}", key, title_, value),
                  fmt::format("it may be {}", allowed(limits)));
  }
  return value;
}

double YamlSection::number(std::string_view key, const Limits& limits,
                           std::optional<double> fallback) {
  const YAML::Node node = require(key, fallback.has_value());
  if (node.Type() == YAML::NodeType::Undefined) return fallback.value_or(1.0);
  return scalar(node, key, limits);
}

Eigen::Vector3d YamlSection::vector(std::string_view key,
                                    const std::optional<Eigen::Vector3d>& fallback) {
  const YAML::Node node = require(key, fallback.has_value());
  if (node.Type() == YAML::NodeType::Undefined) return fallback.value_or(Eigen::Vector3d::Zero());
  if (!node.IsSequence() || node.size() != 3) {
    problem_->add(node.Mark(), fmt::format("'{}' of {} must be three numbers", key, title_),
                  "write it as [x, y, z]");
    return Eigen::Vector3d::Zero();
  }
  return {scalar(node[0], key, kPlace), scalar(node[1], key, kPlace), scalar(node[2], key, kPlace)};
}

std::vector<double> YamlSection::numbers(std::string_view key, std::size_t count) {
  const YAML::Node node = require(key, false);
  std::vector<double> values(count, 0.0);
  if (node.Type() == YAML::NodeType::Undefined) return values;
  if (!node.IsSequence() || node.size() != count) {
    problem_->add(node.Mark(), fmt::format("'{}' of {} must be {} numbers", key, title_, count));
    return values;
  }
  for (std::size_t i = 0; i < count; ++i) values[i] = scalar(node[i], key, kAnyNumber);
  return values;
}

std::string YamlSection::text(std::string_view key, const std::optional<std::string>& fallback) {
  const YAML::Node node = require(key, fallback.has_value());
  if (node.Type() == YAML::NodeType::Undefined) return fallback.value_or("");
  if (node.IsScalar()) return node.Scalar();
  problem_->add(node.Mark(), fmt::format("'{}' of {} must be a text", key, title_));
  return {};
}

std::optional<YamlSection> YamlSection::section(std::string_view key) {
  const YAML::Node node = find(key);
  if (node.Type() == YAML::NodeType::Undefined) return std::nullopt;
  return YamlSection(node, fmt::format("'{}'", key), *problem_);
}

std::vector<YamlSection> YamlSection::list(std::string_view key) {
  const YAML::Node node = find(key);
  std::vector<YamlSection> sections;
  if (node.Type() == YAML::NodeType::Undefined) return sections;
  if (!node.IsSequence()) {
    problem_->add(node.Mark(), fmt::format("'{}' of {} must be a list", key, title_));
    return sections;
  }
  for (const YAML::Node& entry : node)
    sections.emplace_back(entry, fmt::format("an entry of '{}'", key), *problem_);
  return sections;
}

std::vector<std::pair<std::string, YamlSection>> YamlSection::named(std::string_view key) {
  const YAML::Node node = find(key);
  std::vector<std::pair<std::string, YamlSection>> sections;
  if (node.Type() == YAML::NodeType::Undefined) return sections;
  if (!node.IsMap()) {
    problem_->add(node.Mark(), fmt::format("'{}' of {} must map names to values", key, title_));
    return sections;
  }
  for (const auto& entry : node) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    sections.emplace_back(name, YamlSection(entry.second, fmt::format("'{}'", name), *problem_));
  }
  return sections;
}

void YamlSection::finish() {
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::ranges::find(known_, key) == known_.end()) {
      std::set<std::string> names(known_.begin(), known_.end());
      problem_->add(entry.first.Mark(), fmt::format("unknown key '{}' in {}", key, title_),
                    fmt::format("known are: {}", fmt::join(names, ", ")));
    } else if (!seen.insert(key).second) {
      problem_->add(entry.first.Mark(),
                    fmt::format("the key '{}' of {} stands twice", key, title_));
    }
  }
}

}  // namespace swiftlet::sim
