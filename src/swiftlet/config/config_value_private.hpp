// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/pipeline/new_world_rule.hpp"

namespace swiftlet {

// Reads one parameter of each type that visit_config() knows. `key` tells the unit by its suffix.
// Errors: kInvalidConfig with what and remedy; the caller adds the place.
[[nodiscard]] Status read_value(std::string_view key, const YAML::Node& node, double& out);
[[nodiscard]] Status read_value(std::string_view key, const YAML::Node& node, int& out);
[[nodiscard]] Status read_value(std::string_view key, const YAML::Node& node, std::string& out);
[[nodiscard]] Status read_value(std::string_view key, const YAML::Node& node, NewWorldRule& out);
/// One number stands for all three axes.
[[nodiscard]] Status read_value(std::string_view key, const YAML::Node& node, Eigen::Vector3d& out);
[[nodiscard]] Status read_value(std::string_view key, const YAML::Node& node,
                                std::vector<std::string>& out);

// Writes it so that it reads back bit for bit.
[[nodiscard]] std::string value_text(double value);
[[nodiscard]] std::string value_text(int value);
[[nodiscard]] std::string value_text(const std::string& value);
[[nodiscard]] std::string value_text(NewWorldRule value);
[[nodiscard]] std::string value_text(const Eigen::Vector3d& value);
[[nodiscard]] std::string value_text(const std::vector<std::string>& value);

}  // namespace swiftlet
