// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <filesystem>

#include "swiftlet/source/rig/rig_file.hpp"

namespace swiftlet {
namespace {

TEST(SampleRigs, can_be_read_as_they_are) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(SWIFTLET_EXAMPLES "/rigs")) {
    const auto rig = load_rig(file.path());
    EXPECT_TRUE(rig) << rig.error().text();
    ++count;
  }
  EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace swiftlet
