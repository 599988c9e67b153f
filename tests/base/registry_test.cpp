// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace swiftlet {
namespace {

constexpr std::array kTable{Registered<int>{"line", "thin", 1},
                            Registered<int>{"voxel", "thick", 2}};

TEST(FindRegistered, finds_every_line_by_its_name) {
  for (const auto& row : kTable) {
    const auto found = find_registered<Registered<int>>(kTable, row.name, "method");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->make, row.make);
  }
}

TEST(FindRegistered, answers_an_unknown_name_with_the_known_ones) {
  const auto found = find_registered<Registered<int>>(kTable, "vox", "ray method");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  EXPECT_EQ(found.error().text(), "unknown ray method 'vox'; known are: line, voxel");
}

}  // namespace
}  // namespace swiftlet
