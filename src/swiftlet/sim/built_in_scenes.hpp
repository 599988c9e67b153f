// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string_view>

namespace swiftlet::sim {

/// A file of sim/scenes/, embedded by cmake/embed_scenes.cmake.
struct BuiltInScene {
  std::string_view name;
  std::string_view about;  ///< its line of that key
  std::string_view yaml;
};

/// In the order of their names.
[[nodiscard]] std::span<const BuiltInScene> built_in_scenes();

}  // namespace swiftlet::sim
