// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <type_traits>
#include <utility>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

/// The one place where an integer may become a narrower one: checked, in every build type.
template <class To, class From>
[[nodiscard]] constexpr To to(From value) {
  static_assert(std::is_integral_v<To> && std::is_integral_v<From>);
  SWIFTLET_REQUIRE(std::in_range<To>(value), "integer does not fit its destination");
  return static_cast<To>(value);
}

}  // namespace swiftlet
