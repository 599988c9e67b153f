// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/flight_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "support/temp_folder.hpp"
#include "swiftlet/session/flight_recovery.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"
#include "swiftlet/store/stream/block_store.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A map of one block, as a flight leaves it that says so of itself.
void write_map(const fs::path& path, std::string_view flight, MapMeta meta = {}) {
  meta[std::string(kFlightKey)] = flight;
  meta.emplace("created", "2026-11-28T13:24:05Z");
  auto store = BlockStore::create(path, 0.1, {.overwrite = true}, meta).value();
  VoxelBlock block;
  block.clear();
  block.voxels[7] = 255;
  store->evict({1, 2, 3}, block, 1);
  ASSERT_TRUE(store->close());
}

/// The same by a flight that is killed: the block is in the log beside the map.
void write_cut_map(const fs::path& path) {
  const pid_t writer = fork();
  if (writer == 0) {
    auto store = BlockStore::create(path, 0.1, {.batch_interval = std::chrono::milliseconds(1)},
                                    {{std::string(kFlightKey), std::string(kUnderWay)},
                                     {"created", "2026-11-28T13:24:05Z"}})
                     .value();
    VoxelBlock block;
    block.clear();
    block.voxels[7] = 255;
    store->evict({1, 2, 3}, block, 1);
    while (store->stats().blocks_stored == 0) std::this_thread::yield();
    std::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(writer, &status, 0), writer);
}

class FlightFile : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      found.push_back(entry.path().filename());
    std::ranges::sort(found);
    return found;
  }
  std::vector<std::string> recover() const {
    auto notes = recover_cut_flights(folder_ / "a.swl");
    EXPECT_TRUE(notes) << notes.error().text();
    return notes.value_or(std::vector<std::string>{});
  }

  test::TempFolder folder_;
};

TEST_F(FlightFile, of_a_flight_that_was_cut_off_is_kept_under_its_start_and_never_over_another) {
  for (int time = 0; time < 3; ++time) {
    write_map(folder_ / "a.swl", kUnderWay);
    EXPECT_THAT(recover(), ElementsAre(HasSubstr("a flight was cut off")));
  }
  write_map(folder_ / "a.world2.swl", kUnderWay);
  recover();
  EXPECT_THAT(names(),
              ElementsAre("a.2026-11-28T13-24-05.cut-2.swl", "a.2026-11-28T13-24-05.cut-3.swl",
                          "a.2026-11-28T13-24-05.cut.swl", "a.world2.2026-11-28T13-24-05.cut.swl"));
  for (const std::string& name : names()) EXPECT_THAT(check_map(folder_ / name), IsEmpty());
}

TEST_F(FlightFile, is_kept_with_all_that_was_mapped_even_while_somebody_reads_it) {
  for (const bool is_read : {false, true}) {
    write_cut_map(folder_ / "a.swl");
    std::optional<Expected<SavedMap>> reader;
    if (is_read) {
      reader.emplace(load_map(folder_ / "a.swl"));
      ASSERT_TRUE(*reader) << reader->error().text();
    }
    recover();
    reader.reset();
    const fs::path kept = folder_ / "a.2026-11-28T13-24-05.cut.swl";
    const auto map = load_map(kept);
    ASSERT_TRUE(map) << map.error().text();
    EXPECT_EQ(map->block_count(), 1U);
    EXPECT_THAT(check_map(kept), IsEmpty());
    EXPECT_FALSE(fs::exists(folder_ / "a.swl"));
    for (const std::string& name : names()) fs::remove(folder_ / name);
  }
}

TEST_F(FlightFile, that_is_finished_foreign_or_damaged_stays_where_it_is) {
  for (const std::string_view end : {kSavedWhole, kSavedInPart}) {
    write_map(folder_ / "a.swl", end);
    EXPECT_THAT(recover(), IsEmpty());
    EXPECT_THAT(names(), ElementsAre("a.swl"));
  }
  for (const char* content : {"", "dear diary", "SQLite format 3"}) {
    test::write_file(folder_ / "a.swl", content);
    EXPECT_THAT(recover(), IsEmpty());
    EXPECT_EQ(test::content_of(folder_ / "a.swl"), content);
  }
}

TEST_F(FlightFile, takes_its_name_from_no_odd_line_of_the_map) {
  write_map(folder_ / "a.swl", kUnderWay, {{"created", "../../etc/2026-11-28T13"}});
  recover();
  ASSERT_EQ(names().size(), 1U);
  EXPECT_THAT(names().front(), ::testing::MatchesRegex("a[.]....-..-..T..-..-..[.]cut[.]swl"));
}

TEST_F(FlightFile, that_was_to_be_replaced_gets_its_name_back) {
  write_map(folder_ / "a.swl", kSavedWhole);
  const std::string old = test::content_of(folder_ / "a.swl");
  const auto aside = set_map_aside(folder_ / "a.swl");
  ASSERT_TRUE(aside);
  EXPECT_EQ(test::content_of(folder_ / "a.swl"), old) << "at no moment there is none";
  recover();  // cut off before anything was written
  EXPECT_THAT(names(), ElementsAre("a.swl"));

  const auto again = set_map_aside(folder_ / "a.swl");
  write_map(folder_ / "a.swl", kUnderWay, {{std::string(kReplacesKey), again->filename()}});
  EXPECT_EQ(recover().size(), 2U);
  EXPECT_THAT(names(), ElementsAre("a.2026-11-28T13-24-05.cut.swl", "a.swl"));
  EXPECT_EQ(test::content_of(folder_ / "a.swl"), old);
}

TEST_F(FlightFile, that_was_replaced_goes_only_if_the_new_map_says_so) {
  write_map(folder_ / "a.swl", kSavedWhole);
  const auto aside = set_map_aside(folder_ / "a.swl");
  write_map(folder_ / "a.swl", kSavedInPart, {{std::string(kReplacesKey), aside->filename()}});
  recover();
  EXPECT_EQ(names().size(), 2U) << "the new map is not whole";
  write_map(folder_ / "a.swl", kSavedWhole);
  recover();
  EXPECT_EQ(names().size(), 2U) << "another map";
  write_map(folder_ / "a.swl", kSavedWhole, {{std::string(kReplacesKey), aside->filename()}});
  recover();
  EXPECT_THAT(names(), ElementsAre("a.swl"));
}

TEST_F(FlightFile, may_not_be_an_input_nor_replace_what_is_no_map) {
  write_map(folder_ / "map.swl", kSavedWhole);
  test::write_file(folder_ / "in.bag", "bag");
  fs::create_hard_link(folder_ / "in.bag", folder_ / "twin.swl");
  fs::create_symlink("in.bag", folder_ / "link.swl");
  const std::array inputs{folder_ / "in.bag"};
  const auto complaint = [&](const char* name, bool overwrite) {
    const auto status = check_flight_file(folder_ / name, overwrite, inputs);
    return status ? std::string("fine") : status.error().what;
  };
  EXPECT_EQ(complaint("new.swl", false), "fine");
  EXPECT_EQ(complaint("map.swl", true), "fine");
  EXPECT_EQ(complaint("map.swl", false), "the file exists");
  for (const char* name : {"in.bag", "twin.swl", "link.swl"}) {
    EXPECT_THAT(complaint(name, true), HasSubstr("this is the input"));
  }
  EXPECT_THAT(complaint(".", true), HasSubstr("is not a file"));
  test::write_file(folder_ / "diary.txt", "dear diary");
  EXPECT_THAT(complaint("diary.txt", true), HasSubstr("no Swiftlet map"));
}

TEST_F(FlightFile, is_marked_without_harm_to_its_checksum) {
  write_map(folder_ / "a.swl", kUnderWay);
  ASSERT_TRUE(mark_map(folder_ / "a.swl", {{std::string(kFlightKey), std::string(kSavedWhole)}}));
  ASSERT_TRUE(mark_map(folder_ / "a.swl", {{"a new line", "its value"}, {"another", ""}}));
  EXPECT_THAT(check_map(folder_ / "a.swl"), IsEmpty());
  EXPECT_EQ(load_map(folder_ / "a.swl")->meta().at("flight"), kSavedWhole);
  EXPECT_THAT(names(), ElementsAre("a.swl"));
}

TEST(StartTime, stands_for_every_percent_t_and_for_nothing_else) {
  constexpr std::time_t kStart = 1'795'872'245;
  EXPECT_EQ(with_start_time("a-%t.swl", kStart), "a-2026-11-28T13-24-05.swl");
  EXPECT_EQ(with_start_time("%t/%t", 0), "1970-01-01T00-00-00/1970-01-01T00-00-00");
  EXPECT_EQ(with_start_time("100%.swl", kStart), "100%.swl");
}

}  // namespace
}  // namespace swiftlet
