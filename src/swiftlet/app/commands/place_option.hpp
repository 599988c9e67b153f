// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <optional>
#include <string>

namespace swiftlet::app {

/// Declares an option whose value is a place, `x,y,z` [m, world].
CLI::Option* declare_place(CLI::App& parser, const std::string& name,
                           std::optional<Eigen::Vector3d>& place, const std::string& what);

}  // namespace swiftlet::app
