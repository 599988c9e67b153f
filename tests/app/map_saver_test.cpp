// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/map_saver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::app {
namespace {

BlockMap random_copy(test::Random& random, std::size_t count) {
  BlockMap map({0.05, {}, 77});
  while (map.block_count() < count) {
    VoxelBlock block;
    for (QuantizedLogOdds& voxel : block.voxels)
      voxel = static_cast<QuantizedLogOdds>(random.integer(0, 255));
    const auto place = [&] { return random.integer(-100'000, 100'000); };
    map.put({place(), place(), place()}, block);
  }
  return map;
}

TEST(MapSaver, makes_a_sound_map_file_of_exactly_these_blocks) {
  test::for_each_seed(3, [](test::Random& random) {
    const test::TempFolder folder;
    const auto map = random_copy(random, random.integer<std::size_t>(1, 300));
    const MapMeta meta{{"source", "sim:test"}, {"config", "map: {}\n"}};
    const auto bytes = map_saver(meta)(map);
    ASSERT_TRUE(bytes) << bytes.error().text();
    const auto path = folder.path() / "got.swl";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes->data()),
               static_cast<std::streamsize>(bytes->size()));
    EXPECT_TRUE(check_map(path).empty());
    const auto read = load_map(path);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->voxel_m(), 0.05);
    EXPECT_EQ(read->frames(), 77U);
    EXPECT_EQ(read->meta().at("source"), "sim:test");
    EXPECT_EQ(read->block_count(), map.block_count());
    for (const BlockIndex& index : map.sorted_blocks()) {
      const auto found = read->find(index);
      ASSERT_TRUE(found && *found) << random.repeat();
      EXPECT_EQ(**found, *map.find(index)) << random.repeat();
    }
    EXPECT_EQ(map_saver(meta)(map).value(), *bytes) << "the same map gives the same bytes";
  });
}

TEST(MapSaver, says_that_there_is_no_room_for_temporary_files) {
  test::Random random;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", "/proc/nowhere", 1);
  const auto refused = map_saver({})(random_copy(random, 1));
  if (before == nullptr) {
    unsetenv("TMPDIR");
  } else {
    setenv("TMPDIR", kept.c_str(), 1);
  }
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text(), ::testing::HasSubstr("set TMPDIR"));
}

}  // namespace
}  // namespace swiftlet::app
