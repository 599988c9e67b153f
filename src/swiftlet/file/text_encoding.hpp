// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

namespace swiftlet {

/// A text without its byte order mark, as UTF-8: a mark of UTF-16 has the rest turned into it, half
/// a surrogate becoming U+FFFD. A text without a mark is given back as it is.
[[nodiscard]] std::string without_byte_order_mark(std::string text);

}  // namespace swiftlet
