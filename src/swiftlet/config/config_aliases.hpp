// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string_view>

namespace swiftlet {

/// A parameter that had another key in the version before this one.
struct RenamedKey {
  std::string_view before, now;
};

/// A name that a parameter's value had in the version before this one.
struct RenamedValue {
  std::string_view key;  ///< as it is now
  std::string_view before, now;
};

// What the version before this one wrote is accepted for one version, with a warning; then its
// lines go (docs/glossary.md has the same table for readers).
[[nodiscard]] std::span<const RenamedKey> renamed_keys();
[[nodiscard]] std::span<const RenamedValue> renamed_values();

/// The key that a key of this version or the one before has now.
[[nodiscard]] std::string_view current_key(std::string_view key);

/// The value that a value of this version or the one before has now, under a key as it is now.
[[nodiscard]] std::string_view current_value(std::string_view key, std::string_view value);

}  // namespace swiftlet
