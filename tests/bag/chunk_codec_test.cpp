// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/chunk_codec.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(PackedMessages, that_would_grow_without_end_are_told_from_depth) {
  EXPECT_TRUE(is_growth_plausible(1000, 20'000));
  EXPECT_TRUE(is_growth_plausible(100U << 20U, 100ULL << 30U));
  EXPECT_TRUE(is_growth_plausible(1U << 20U, 8ULL << 30U)) << "a camera that sees nothing";
  EXPECT_FALSE(is_growth_plausible(1U << 20U, 40ULL << 30U));
}

}  // namespace
}  // namespace swiftlet
