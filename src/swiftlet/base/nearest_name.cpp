// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/nearest_name.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace swiftlet {
namespace {

/// Levenshtein distance, one row at a time.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// A key without its section ("voxel_m") stands for the whole key.
std::size_t distance(std::string_view typed, std::string_view name) {
  const bool has_section = typed.find('.') != std::string_view::npos;
  const auto dot = name.rfind('.');
  if (has_section || dot == std::string_view::npos) return edits(typed, name);
  return std::min(edits(typed, name), edits(typed, name.substr(dot + 1)));
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view typed,
                                        std::span<const std::string> known) {
  const auto nearest = std::ranges::min_element(
      known, {}, [typed](const std::string& name) { return distance(typed, name); });
  if (nearest == known.end() || distance(typed, *nearest) > typed.size() / 3 + 1) {
    return std::nullopt;
  }
  return *nearest;
}

}  // namespace swiftlet
