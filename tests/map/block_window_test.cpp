// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/block_window.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/seeds.hpp"
#include "swiftlet/map/block_directory.hpp"

namespace swiftlet {
namespace {

using test::Random;

BlockIndex random_index(Random& random, int range) {
  return {random.integer(-range, range), random.integer(-range, range),
          random.integer(-range, range)};
}

TEST(BlockWindow, blocks_outside_another_window_are_exactly_the_set_difference) {
  Random random;
  for (int trial = 0; trial < 500; ++trial) {
    const BlockIndex size{random.integer(1, 5), random.integer(1, 5), random.integer(1, 5)};
    const BlockWindow a{random_index(random, 6), size}, b{random_index(random, 6), size};
    std::set<BlockIndex> expected;
    for_each_block(a, [&](const BlockIndex& i) {
      if (!b.contains(i)) expected.insert(i);
    });
    std::size_t visits = 0;
    std::set<BlockIndex> got;
    for_each_block_outside(a, b, [&](const BlockIndex& i) {
      got.insert(i);
      ++visits;
    });
    ASSERT_EQ(got, expected) << random.repeat();
    ASSERT_EQ(visits, expected.size()) << "a block was visited twice; " << random.repeat();
  }
}

TEST(BlockDirectory, gives_every_block_of_a_window_an_entry_of_its_own_that_moving_keeps) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const BlockIndex size{random.integer(1, 6), random.integer(1, 6), random.integer(1, 6)};
    BlockDirectory directory(size);
    directory.move_to(random_index(random, 1000));
    std::set<std::size_t> entries;
    for_each_block(directory.window(),
                   [&](const BlockIndex& b) { entries.insert(directory.entry_of(b)); });
    ASSERT_EQ(entries.size(), directory.entry_count()) << random.repeat();

    const BlockIndex& first = directory.window().first;
    const BlockIndex kept{first.x + size.x - 1, first.y + size.y - 1, first.z + size.z - 1};
    const std::size_t entry = directory.entry_of(kept);
    directory.move_to({first.x + random.integer(0, size.x - 1), first.y, first.z});
    ASSERT_EQ(directory.entry_of(kept), entry) << random.repeat();
  }
}

}  // namespace
}  // namespace swiftlet
