// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/config/parameter_table.hpp"

#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace swiftlet {
namespace {

TEST(ParametersPage, is_the_one_that_the_program_writes) {
  EXPECT_EQ(test::content_of(SWIFTLET_SOURCE_DIR "/docs/parameters.md"), parameters_markdown())
      << "run: swiftlet list parameters --markdown > docs/parameters.md";
}

}  // namespace
}  // namespace swiftlet
