// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/salvage.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using test::Blocks;
using test::Random;
using test::TempFolder;

/// A map of some hundred blocks on some dozen pages, with a description that is longer than a page.
Blocks write_salvage_map(const std::filesystem::path& path, Random& random, int blocks = 150) {
  Blocks truth;
  auto store =
      BlockStore::create(path, 0.1, {}, {{"config", std::string(6000, '#')}, {"start_m", "1 -2 3"}})
          .value();
  for (int i = 0; i < blocks; ++i) {
    const BlockIndex index{random.integer(-20, 20), random.integer(-20, 20), random.integer(-2, 2)};
    truth[index] = i % 3 == 0 ? test::random_block(random) : test::block_full_of(i % 256);
    store->evict(index, truth[index], static_cast<std::uint64_t>(i));
  }
  EXPECT_TRUE(store->close());
  return truth;
}

Blocks blocks_of(const SavedMap& map) {
  Blocks blocks;
  auto read = map.for_each_block([&](const BlockIndex& index, const VoxelBlock& b) -> Status {
    blocks[index] = b;
    return Done{};
  });
  EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().text());
  return blocks;
}

void change_with_sql(const std::filesystem::path& path, const std::string& sql) {
  auto database = sqlite::Database::open(path, sqlite::Database::Mode::kReadWrite);
  ASSERT_TRUE(database.has_value());
  ASSERT_TRUE(database->run(sql));
}

TEST(Salvage, of_a_sound_map_is_the_map) {
  const TempFolder folder;
  Random random;
  const Blocks truth = write_salvage_map(folder / "a.swl", random);
  const auto report = salvage_map(folder / "a.swl", folder / "b.swl");
  ASSERT_TRUE(report.has_value()) << report.error().text();
  EXPECT_TRUE(report->is_whole());
  EXPECT_TRUE(check_map(folder / "b.swl").empty());
  EXPECT_EQ(test::blocks_in(folder / "b.swl"), truth) << random.repeat();
  EXPECT_EQ(load_map(folder / "b.swl")->meta(), load_map(folder / "a.swl")->meta());
  EXPECT_EQ(salvage_map(folder / "a.swl", folder / "b.swl").error().code, ErrorCode::kUsage);
}

TEST(Salvage, leaves_out_a_damaged_block_and_names_it) {
  const TempFolder folder;
  Random random;
  Blocks truth = write_salvage_map(folder / "a.swl", random);
  const BlockIndex bad = std::next(truth.begin(), 7)->first;
  change_with_sql(folder / "a.swl",
                  "UPDATE blocks SET checksum = checksum + 1 WHERE x = " + std::to_string(bad.x) +
                      " AND y = " + std::to_string(bad.y) + " AND z = " + std::to_string(bad.z));
  const auto refused = summarize(*load_map(folder / "a.swl"));
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().remedy.find("--salvage"), std::string::npos);
  const auto found = load_salvaged(folder / "a.swl");
  ASSERT_TRUE(found.has_value()) << found.error().text();
  EXPECT_EQ(found->second.damaged, std::vector{bad});
  EXPECT_EQ(found->second.missing, 1U);
  truth.erase(bad);
  EXPECT_EQ(found->second.kept, truth.size());
  EXPECT_EQ(blocks_of(found->first), truth) << random.repeat();
}

/// What is kept is true, and what is not is counted, wherever the damage lies.
void expect_honest(const std::filesystem::path& path, const Blocks& truth, int& given_up,
                   const std::string& where) {
  const auto found = load_salvaged(path);
  if (!found) {
    EXPECT_EQ(found.error().code, ErrorCode::kCorruptInput) << where;
    ++given_up;
    return;
  }
  const auto& [map, report] = *found;
  const Blocks kept = blocks_of(map);
  for (const auto& [index, block] : kept) {
    const auto known = truth.find(index);
    ASSERT_TRUE(known != truth.end() && known->second == block) << where;
  }
  ASSERT_EQ(report.kept, kept.size()) << where;
  if (report.missing && report.notes.empty()) {
    ASSERT_EQ(kept.size() + *report.missing, truth.size()) << where;
  }
  if (report.is_whole()) {
    ASSERT_EQ(kept, truth) << where;
  }
  EXPECT_GE(kept.size() + 110, truth.size()) << where << ": one page holds fewer";
}

TEST(Salvage, tells_the_truth_wherever_a_byte_or_a_sector_is_damaged) {
  const TempFolder folder;
  Random random;
  const Blocks truth = write_salvage_map(folder / "a.swl", random);
  const auto whole = test::bytes_of(folder / "a.swl");
  int rounds = 0, given_up = 0;
  for (const std::size_t size : {std::size_t{1}, std::size_t{512}}) {
    const std::size_t step = size == 1 ? 397 : 512;
    for (std::size_t at = 0; at + size <= whole.size(); at += step, ++rounds) {
      auto bytes = whole;
      for (std::size_t i = at; i < at + size; ++i) bytes[i] = static_cast<char>(~bytes[i]);
      test::write_bytes(folder / "b.swl", bytes);
      ASSERT_NO_FATAL_FAILURE(expect_honest(
          folder / "b.swl", truth, given_up,
          std::to_string(size) + " bytes at " + std::to_string(at) + "; " + random.repeat()));
    }
  }
  EXPECT_LT(given_up, rounds / 10) << "only where the voxel size stands";
}

TEST(Salvage, finds_the_blocks_of_a_file_without_its_header_and_of_one_that_is_cut_off) {
  const TempFolder folder;
  Random random;
  const Blocks truth = write_salvage_map(folder / "a.swl", random);
  const auto whole = test::bytes_of(folder / "a.swl");
  auto headless = whole;
  std::fill_n(headless.begin(), 4096, '\0');
  test::write_bytes(folder / "b.swl", headless);
  EXPECT_FALSE(load_map(folder / "b.swl").has_value());
  const auto found = load_salvaged(folder / "b.swl");
  ASSERT_TRUE(found.has_value()) << found.error().text();
  EXPECT_EQ(blocks_of(found->first), truth);

  const auto half = static_cast<std::ptrdiff_t>(whole.size() * 3 / 4 + 1000);
  test::write_bytes(folder / "c.swl", {whole.begin(), whole.begin() + half});
  const auto cut = load_salvaged(folder / "c.swl");
  ASSERT_TRUE(cut.has_value()) << cut.error().text();
  EXPECT_FALSE(cut->second.is_whole());
  EXPECT_GT(cut->second.kept, 0U);
  EXPECT_EQ(cut->second.missing, truth.size() - cut->second.kept);
  EXPECT_FALSE(cut->second.gaps.empty()) << "where they lay";
}

TEST(Salvage, does_not_bring_back_what_the_map_has_forgotten) {
  const TempFolder folder;
  Random random;
  auto store = BlockStore::create(folder / "a.swl", 0.1, {.max_bytes = 200 * 1024}).value();
  for (int i = 0; i < 600; ++i) {
    store->evict({i, 0, 0}, test::random_block(random), static_cast<std::uint64_t>(i));
  }
  ASSERT_TRUE(store->close());
  ASSERT_GT(store->stats().dropped_by_cap, 0U);
  const auto found = load_salvaged(folder / "a.swl");
  ASSERT_TRUE(found.has_value()) << found.error().text();
  EXPECT_TRUE(found->second.is_whole());
  EXPECT_EQ(blocks_of(found->first), test::blocks_in(folder / "a.swl"));
}

TEST(Salvage, reads_the_log_of_a_writer_that_was_killed) {
  const TempFolder folder;
  Random random;
  auto store =
      BlockStore::create(folder / "a.swl", 0.1, {.batch_interval = std::chrono::milliseconds(1)})
          .value();
  for (int i = 0; i < 50; ++i) store->evict({i, 0, 0}, test::block_full_of(i), 1);
  while (store->stats().blocks_stored < 50) std::this_thread::yield();
  for (const char* suffix : {"", "-wal"}) {  // as it lies there at this moment
    std::filesystem::copy_file(folder / (std::string("a.swl") + suffix),
                               folder / (std::string("b.swl") + suffix));
  }
  const auto found = load_salvaged(folder / "b.swl");
  ASSERT_TRUE(found.has_value()) << found.error().text();
  EXPECT_TRUE(found->second.is_whole());
  EXPECT_EQ(found->second.kept, 50U);
}

TEST(HostileMap, pages_that_lead_to_one_page_again_and_again_come_to_an_end) {
  const TempFolder folder;
  Random random;
  write_salvage_map(folder / "a.swl", random, 900);
  auto bytes = test::bytes_of(folder / "a.swl");
  int changed = 0;
  for (std::size_t page = 0; page + 4096 <= bytes.size(); page += 4096) {
    if (bytes[page] != 2) continue;  // an inner page of an index
    const auto number = [&](std::size_t at) {
      return static_cast<std::size_t>(bytes[page + at] & 0xff) << 8U |
             static_cast<std::size_t>(bytes[page + at + 1] & 0xff);
    };
    const std::size_t first = page + number(12);
    for (std::size_t i = 1; i < number(3); ++i, ++changed) {
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(first), 4,
                  bytes.begin() + static_cast<std::ptrdiff_t>(page + number(12 + 2 * i)));
    }
  }
  ASSERT_GT(changed, 0);
  test::write_bytes(folder / "b.swl", bytes);
  const auto map = load_map(folder / "b.swl");
  if (map) {
    EXPECT_FALSE(summarize(*map).has_value());
  }
  EXPECT_FALSE(check_map(folder / "b.swl").empty());
  const auto found = load_salvaged(folder / "b.swl");
  ASSERT_TRUE(found.has_value()) << found.error().text();
  EXPECT_GT(found->second.kept, 0U);
}

TEST(HostileMap, the_start_of_the_flight_must_be_a_place_in_the_world) {
  for (const char* start : {"nan 0 0", "inf 0 0", "1 2", "1 2 3 4", "1e300 0 0", "", "a b c"}) {
    const TempFolder folder;
    const MapMeta meta{{"voxel_m", "0.1"}, {"frames", "0"}, {"start_m", start}};
    ASSERT_TRUE(MapFile::create(folder / "a.swl", false, meta));
    const auto map = load_map(folder / "a.swl");
    ASSERT_FALSE(map.has_value()) << start;
    EXPECT_NE(map.error().text().find("start_m"), std::string::npos);
    EXPECT_FALSE(check_map(folder / "a.swl").empty());
    const auto found = load_salvaged(folder / "a.swl");
    ASSERT_TRUE(found.has_value()) << found.error().text();
    EXPECT_FALSE(found->first.header().start_m.has_value());
  }
  const TempFolder folder;
  Random random;
  write_salvage_map(folder / "a.swl", random, 3);
  EXPECT_EQ(load_map(folder / "a.swl")->header().start_m, Eigen::Vector3d(1.0, -2.0, 3.0));
}

}  // namespace
}  // namespace swiftlet
