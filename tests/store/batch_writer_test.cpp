// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/stream/batch_writer.hpp"

#include <gtest/gtest.h>

#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using test::block_full_of;
using test::TempFolder;

/// One block that goes in and out of a window; which state does the file hold?
class BatchOrder : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(MapFile::create(path_, false));
    auto opened = BatchWriter::open(path_, StorePolicy::kKeep, 0);
    ASSERT_TRUE(opened.has_value());
    writer_.emplace(std::move(*opened));
    MapMeta meta{{"voxel_m", "0.1"}};
    ASSERT_TRUE(writer_->write({nullptr, nullptr, &meta}));
    map_.recentre({0, 0, 0}, nullptr);
  }
  MapSnapshot snapshot_with(int value) {
    map_.writable(kBlock) = block_full_of(value);
    return *map_.snapshot({++frame_});
  }
  std::size_t write(const MapSnapshot* window, const BlockBuffer* evicted) {
    auto report = writer_->write({window, evicted, nullptr});
    EXPECT_TRUE(report.has_value());
    return report->written.size();
  }
  void expect_in_file(int value) {
    EXPECT_EQ(test::blocks_in(path_), (test::Blocks{{kBlock, block_full_of(value)}}));
  }
  static BlockBuffer evicted(int value, std::uint64_t version) {
    BlockBuffer buffer(4);
    buffer.put(kBlock, block_full_of(value), version);
    return buffer;
  }

  static constexpr BlockIndex kBlock{0, 0, 0};
  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "a.swl";
  std::optional<BatchWriter> writer_;
  RollingMap map_ = test::small_map();
  std::uint64_t frame_ = 0;
};

TEST_F(BatchOrder, an_older_snapshot_never_overwrites_a_newer_eviction) {
  const MapSnapshot old = snapshot_with(10);
  const BlockBuffer newer = evicted(20, old.version(kBlock) + 1);
  write(&old, &newer);  // the same batch
  expect_in_file(20);
  write(&old, nullptr);  // and a later one, which still sees the old snapshot
  expect_in_file(20);
}

TEST_F(BatchOrder, an_older_eviction_never_overwrites_a_newer_snapshot) {
  const MapSnapshot first = snapshot_with(10);
  const BlockBuffer older = evicted(10, first.version(kBlock));
  const MapSnapshot returned_and_changed = snapshot_with(20);
  write(&returned_and_changed, &older);
  expect_in_file(20);
  write(nullptr, &older);
  expect_in_file(20);
}

TEST_F(BatchOrder, a_snapshot_that_closed_the_epoch_beats_an_eviction_within_it) {
  const MapSnapshot closed = snapshot_with(20);
  const BlockBuffer within = evicted(10, closed.version(kBlock));
  write(nullptr, &within);
  write(&closed, nullptr);
  expect_in_file(20);
  write(nullptr, &within);
  expect_in_file(20);
}

TEST_F(BatchOrder, of_two_evictions_within_one_epoch_the_later_stays) {
  const BlockBuffer first = evicted(10, 5);
  const BlockBuffer second = evicted(20, 5);
  write(nullptr, &first);
  write(nullptr, &second);
  expect_in_file(20);
}

TEST_F(BatchOrder, what_the_file_holds_already_is_not_written_again) {
  const MapSnapshot now = snapshot_with(10);
  EXPECT_EQ(write(&now, nullptr), 1U);
  EXPECT_EQ(write(&now, nullptr), 0U);
  const BlockBuffer same = evicted(10, now.version(kBlock));
  EXPECT_EQ(write(nullptr, &same), 0U);
  expect_in_file(10);
}

TEST_F(BatchOrder, a_batch_that_fails_changes_nothing_and_can_be_tried_again) {
  const BlockBuffer first = evicted(10, 1);
  write(nullptr, &first);
  // Another program, which does not know our lock: ours finds the file in use.
  auto other = sqlite::Database::open(path_, sqlite::Database::Mode::kReadWrite);
  ASSERT_TRUE(other.has_value());
  ASSERT_TRUE(other->run("BEGIN IMMEDIATE"));
  const BlockBuffer second = evicted(20, 2);
  const auto failed = writer_->write({nullptr, &second, nullptr});
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().code, ErrorCode::kIo);
  ASSERT_TRUE(other->run("ROLLBACK"));
  expect_in_file(10);
  EXPECT_EQ(write(nullptr, &second), 1U);
  expect_in_file(20);
}

}  // namespace
}  // namespace swiftlet
