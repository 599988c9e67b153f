// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace swiftlet::test {

/// Where a real recording lies: $SWIFTLET_RECORDED/<name>, by default ../shared/data beside the
/// source tree.
[[nodiscard]] inline std::filesystem::path recorded_folder(std::string_view name) {
  const char* root = std::getenv("SWIFTLET_RECORDED");
  return std::filesystem::path(root != nullptr ? root : SWIFTLET_RECORDED_DEFAULT) / name;
}

}  // namespace swiftlet::test

/// Skips a test, saying why, on machines that do not have the recording.
#define SWIFTLET_NEEDS_RECORDING(folder)              \
  if (!std::filesystem::is_directory(folder))         \
  GTEST_SKIP() << "there is no " << (folder).string() \
               << "; set SWIFTLET_RECORDED to the folder of recordings to run this test"
