// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/state/map_mirror.hpp"

#include <gtest/gtest.h>

#include "support/occupancy_map_laws.hpp"

namespace swiftlet::station {
namespace {

static_assert(OccupancyMap<MapMirror>);

TEST(MapMirror, answers_as_the_map_that_it_mirrors) {
  test::for_each_seed(5, [](test::Random& random) {
    const VoxelBox box{{-34, -15, -8}, {28, 30, 9}};
    const test::MapModel before = test::random_model(random, box);
    const test::MapModel after = test::random_model(random, box);
    MapMirror mirror(MapHeader{after.voxel_m, after.scale});
    const auto put_all = [&](const test::MapModel& model, std::uint64_t version) {
      block_map_of(model).for_each_known_block(
          [&](const BlockIndex& index, const VoxelBlock& block) {
            mirror.put(index, block, version);
          });
    };
    put_all(before, 1);
    VoxelBlock unknown;
    unknown.clear();
    for_each_block(blocks_around(box),
                   [&](const BlockIndex& index) { mirror.put(index, unknown, 2); });
    EXPECT_EQ(mirror.digest(), MapDigest{}) << "all forgotten";
    put_all(after, 3);
    test::expect_answers_of(after, mirror, box, random);
    test::expect_answers_of(after, mirror.copy(), box, random);
  });
}

}  // namespace
}  // namespace swiftlet::station
