// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Starts a thread, or says that the system has none to give. `where` is the part that wants it.
/// Errors: kOutOfMemory.
template <class Work>
[[nodiscard]] Expected<std::thread> start_thread(std::string where, Work work) {
  try {
    return std::thread(std::move(work));
  } catch (const std::system_error&) {
    return fail(ErrorCode::kOutOfMemory, std::move(where), "the system starts no further thread",
                "raise its limit ('ulimit -u', memory) or end other programs");
  }
}

}  // namespace swiftlet
