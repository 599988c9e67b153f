// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"

// For a table whose lines need a build option: SWIFTLET_IF_BUILT(SWIFTLET_HAS_..., function) is the
// function where the option is 1, and nullptr where it is 0. A function whose part was not built
// must not even be named: there is nothing to link.
#define SWIFTLET_IF_BUILT(built, function) SWIFTLET_IF_BUILT_EXPANDED(built, function)
#define SWIFTLET_IF_BUILT_EXPANDED(built, function) SWIFTLET_IF_BUILT_##built(function)
#define SWIFTLET_IF_BUILT_1(function) function
#define SWIFTLET_IF_BUILT_0(function) nullptr
#define SWIFTLET_HAS_ALWAYS 1

namespace swiftlet {

/// One line of a registry: a name the user types, a sentence for `swiftlet list`, and how to make
/// the thing. Registries are explicit tables, not self-registering objects: a linker drops those
/// from a static library.
template <class Make>
struct Registered {
  std::string_view name;
  std::string_view summary;
  Make make;                    ///< null where the part was not built
  std::string_view needs = {};  ///< the build option that such a part waits for, as in "EMBREE"
};

/// The entry of that name. Errors: kUsage naming what there is; `kind` is the noun, as in "ray
/// method".
template <class Entry>
[[nodiscard]] Expected<Entry> find_registered(std::span<const Entry> table, std::string_view name,
                                              std::string_view kind) {
  const auto found = std::ranges::find(table, name, &Entry::name);
  if (found != table.end()) return *found;
  std::string known;
  for (const auto& entry : table) known += (known.empty() ? "" : ", ") + std::string(entry.name);
  return fail(ErrorCode::kUsage, {},
              "unknown " + std::string(kind) + " '" + std::string(name) + "'",
              "known are: " + known);
}

}  // namespace swiftlet
