// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swiftlet::test {

struct TracedRun {
  int calls = 0;  ///< of the system, that change a file
  bool was_killed = false;
  int exit_code = 0;  ///< if it was not
};

/// Runs the program in a folder and kills it (SIGKILL) just before its n-th call of the system that
/// changes a file: makes, writes, syncs, renames or removes one; 0: never. What it prints goes
/// nowhere. nullopt where this process may not trace another.
[[nodiscard]] std::optional<TracedRun> run_until_call(const std::vector<std::string>& arguments,
                                                      const std::filesystem::path& folder, int n);

}  // namespace swiftlet::test
