// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// What a YAML text may cost, so that a hostile one is an error instead of a full memory or stack.
/// A node is a value, a list or a group of keys, and an alias counts as all that it repeats.
struct YamlLimits {
  std::size_t bytes = 4U << 20U;
  std::size_t depth = 64;
  std::size_t nodes = 400'000;
  /// Small texts may say little: so many nodes a byte, and some to begin with. Without aliases no
  /// text has more than about one.
  std::size_t nodes_per_byte = 4;
  std::size_t nodes_to_begin = 10'000;
};

/// Reads a YAML text of one document: the only reader there is, for configs, rigs, scenes and
/// calibrations, from files and from maps. The events are counted before any tree is built, so work
/// and memory stay within the limits, and no node of the result lies within itself.
/// Errors: kInvalidConfig at `place`:line for what is no YAML, is too large or too deep, repeats
/// itself through an alias, or has a second document.
/// The accessors of a YAML::Node throw YAML::Exception: the caller keeps those from its own API.
[[nodiscard]] Expected<YAML::Node> parse_yaml(std::string_view text, const std::string& place,
                                              const YamlLimits& limits = {});

}  // namespace swiftlet
