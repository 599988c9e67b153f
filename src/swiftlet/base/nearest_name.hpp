// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swiftlet {

/// What the user may have meant: the known name with the fewest edits, if it is close at all.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view typed,
                                                      std::span<const std::string> known);

}  // namespace swiftlet
