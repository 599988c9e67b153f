// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/header_lines.hpp"

#include <gtest/gtest.h>

#include "support/occupancy_map_laws.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/salvage.hpp"
#include "swiftlet/store/map_file/save_map.hpp"
#include "swiftlet/store/map_loader.hpp"

namespace swiftlet {
namespace {

const MapMeta kNeeded{{"voxel_m", "0.1"}, {"frames", "7"}};

MapMeta with(MapMeta lines) {
  lines.insert(kNeeded.begin(), kNeeded.end());
  return lines;
}

TEST(SavedMap, loaded_again_answers_as_the_map_that_was_saved) {
  test::for_each_seed(4, [](test::Random& random) {
    const test::TempFolder folder;
    const VoxelBox box{{-34, -15, -8}, {28, 30, 9}};
    const test::MapModel model = test::random_model(random, box);
    BlockMap map = test::block_map_of(model);
    map.set_header({model.voxel_m, model.scale, 12, Eigen::Vector3d(0.1, -2.0, 1e-3)});
    ASSERT_TRUE(save_map(folder / "a.swl", map));
    const auto loaded = read_whole_map((folder / "a.swl").string());
    ASSERT_TRUE(loaded) << loaded.error().text();
    test::expect_answers_of(model, *loaded, box, random);
    EXPECT_EQ(loaded->header().frame_count, 12U);
    EXPECT_EQ(loaded->header().start_m, map.header().start_m);
    const auto file = load_map(folder / "a.swl");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->thresholds(), model.scale.thresholds) << "without any config";
    EXPECT_EQ(summarize(*file)->voxels, summarize(map).voxels);
  });
}

TEST(HeaderLines, thresholds_of_older_files_stand_in_their_config) {
  const std::string config = "map:\n  voxel_m: 0.1\n  retired_key: 3\noccupancy:\n";
  const auto old =
      header_from(with({{"config", config + "  free_below: 90\n  occupied_from: 200\n"}}), "a.swl");
  ASSERT_TRUE(old) << old.error().text();
  EXPECT_EQ(old->scale.thresholds, (OccupancyThresholds{90, 200}));
  const auto both = header_from(with({{"config", config + "  free_below: 90\n"},
                                      {"free_below", "100"},
                                      {"occupied_from", "190"}}),
                                "a.swl");
  EXPECT_EQ(both->scale.thresholds, (OccupancyThresholds{100, 190})) << "their own lines win";
  EXPECT_EQ(header_from(kNeeded, "a.swl")->scale.thresholds, OccupancyThresholds{});
  EXPECT_EQ(header_from(with({{"config", "#\n"}}), "a.swl")->scale.thresholds,
            OccupancyThresholds{});
}

TEST(HeaderLines, what_cannot_be_meant_is_refused_by_name) {
  for (const MapMeta& odd :
       {MapMeta{{"free_below", "0"}, {"occupied_from", "180"}}, MapMeta{{"free_below", "107"}},
        MapMeta{{"free_below", "107"}, {"occupied_from", "127"}},
        MapMeta{{"free_below", "107x"}, {"occupied_from", "180"}},
        MapMeta{{"free_below", "1e2"}, {"occupied_from", "180"}},
        MapMeta{{"config", "occupancy: {free_below: abc}"}},
        MapMeta{{"config", "occupancy: {occupied_from: 300}"}},
        MapMeta{{"config", "occupancy: {free_below: [1]}"}}, MapMeta{{"config", "a: [\n"}}}) {
    const auto header = header_from(with(odd), "a.swl");
    ASSERT_FALSE(header) << odd.begin()->second;
    EXPECT_EQ(header.error().code, ErrorCode::kCorruptInput);
    EXPECT_EQ(header.error().where, "a.swl");
  }
}

TEST(HeaderLines, that_are_refused_are_left_out_by_salvage_which_says_so) {
  for (const MapMeta& odd : {MapMeta{{"free_below", "900"}}, MapMeta{{"config", "a: [\n"}}}) {
    const test::TempFolder folder;
    ASSERT_TRUE(MapFile::create(folder / "a.swl", false, with(odd)));
    EXPECT_FALSE(load_map(folder / "a.swl"));
    EXPECT_FALSE(check_map(folder / "a.swl").empty());
    const auto found = load_salvaged(folder / "a.swl");
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_EQ(found->first.thresholds(), OccupancyThresholds{});
    ASSERT_EQ(found->second.notes.size(), 1U);
    EXPECT_NE(found->second.notes.front().find("thresholds"), std::string::npos);
  }
}

TEST(HeaderLines, put_and_read_give_the_same_header) {
  test::for_each_seed(50, [](test::Random& random) {
    MapHeader header{random.real(1e-3, 1e3), {}, random.integer<std::uint64_t>(0, 1'000'000)};
    header.scale = {{random.integer(1, 127), random.integer(128, 255)}, random.real(1e-3, 1.0)};
    if (random.chance(0.5)) header.start_m = random.vector(-100.0, 100.0);
    MapMeta meta{{"source", "kept"}};
    put_header(header, meta);
    EXPECT_EQ(meta.at("source"), "kept");
    const auto read = header_from(meta, "a.swl");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->voxel_m, header.voxel_m);
    EXPECT_EQ(read->scale, header.scale);
    EXPECT_EQ(read->frame_count, header.frame_count);
    EXPECT_EQ(read->start_m, header.start_m) << random.repeat();
  });
}

}  // namespace
}  // namespace swiftlet
