// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Puts right what flights that were cut off (`kill -9`, power) have left under this name: what
/// they had mapped is kept as "flight.<their start>.cut.swl", and a map that one was about to
/// replace gets its name back. Returns what was done, a sentence each. Errors: kUsage if the
/// map is being written; kIo. Cut off itself, it does the rest the next time.
[[nodiscard]] Expected<std::vector<std::string>> recover_cut_flights(
    const std::filesystem::path& path);

}  // namespace swiftlet
