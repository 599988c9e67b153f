// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet::sim {

/// What a number may be.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_allowed = true;
};
inline constexpr Limits kAnyNumber{};
inline constexpr Limits kPositive{0.0, std::numeric_limits<double>::infinity(), false};
inline constexpr Limits kNotNegative{0.0};
inline constexpr Limits kFraction{0.0, 1.0};
/// Places and lengths [m]: a scene's geometry is in floats, and the map ends there, too.
inline constexpr Limits kPlace{-1e6, 1e6};
inline constexpr Limits kLength{0.0, 1e6, false};

/// The first thing that is wrong with a file; later ones are often its consequences.
struct YamlProblem {
  std::string file;
  std::optional<Error> first;

  void add(const YAML::Mark& mark, std::string what, std::string remedy = {});
};

/// One mapping of a YAML file, read strictly: every key that is asked for is known, every other one
/// is a problem. After a problem the getters return fallbacks, so that a reader needs one check at
/// its end. REQUIRES: the problem outlives the section; finish() is called when all keys were read.
class YamlSection {
 public:
  YamlSection(const YAML::Node& node, std::string title, YamlProblem& problem);

  [[nodiscard]] bool has(std::string_view key);
  [[nodiscard]] double number(std::string_view key, const Limits& limits = kAnyNumber,
                              std::optional<double> fallback = std::nullopt);
  /// A place or a direction; within kPlace.
  [[nodiscard]] Eigen::Vector3d vector(
      std::string_view key, const std::optional<Eigen::Vector3d>& fallback = std::nullopt);
  /// A list of exactly so many numbers.
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count);
  [[nodiscard]] std::string text(std::string_view key,
                                 const std::optional<std::string>& fallback = std::nullopt);
  [[nodiscard]] std::optional<YamlSection> section(std::string_view key);
  /// A list of mappings; empty if the key is absent.
  [[nodiscard]] std::vector<YamlSection> list(std::string_view key);
  /// A mapping of names to mappings; empty if the key is absent.
  [[nodiscard]] std::vector<std::pair<std::string, YamlSection>> named(std::string_view key);

  /// Notes every key that nobody asked for, or that stands twice.
  void finish();
  void problem(std::string what, std::string remedy = {});

 private:
  [[nodiscard]] YAML::Node find(std::string_view key);
  [[nodiscard]] YAML::Node require(std::string_view key, bool is_optional);
  [[nodiscard]] double scalar(const YAML::Node& node, std::string_view key, const Limits& limits);

  YAML::Node node_;
  std::string title_;
  YamlProblem* problem_;
  std::vector<std::string> known_;
};

}  // namespace swiftlet::sim
