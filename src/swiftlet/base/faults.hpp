// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// What went wrong, all of it; empty means that the work is done.
using Faults = std::vector<Error>;

/// The single fault of an Expected that has failed.
template <class T>
[[nodiscard]] Faults fault_of(Expected<T>&& failed) {
  return {std::move(failed).error()};
}

}  // namespace swiftlet
