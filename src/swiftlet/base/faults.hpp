// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
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

/// For people.
[[nodiscard]] inline std::string text_of(const Error& fault) { return fault.text(); }
/// One a line.
[[nodiscard]] inline std::string text_of(const Faults& faults) {
  std::string text;
  for (const Error& fault : faults) text += (text.empty() ? "" : "\n") + fault.text();
  return text;
}

}  // namespace swiftlet
