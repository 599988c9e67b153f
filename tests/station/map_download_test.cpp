// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What map files cost in memory while slow clients take them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "station/station_world.hpp"

#if SWIFTLET_HAS_VIEW
#include "swiftlet/station/http/map_download_private.hpp"

namespace swiftlet::station {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kFile_bytes = 1000;
constexpr std::size_t kBudget_bytes = 3500;

class SlowDownloads : public ::testing::Test {
 protected:
  static MapModel small_world() {
    MapMirror map(small_info().header);
    VoxelBlock block;
    block.clear();
    block.voxels[0] = 200;
    map.put({0, 0, 0}, block, 1);
    return {small_info(), std::move(map)};
  }
  /// What somebody gets who asks two seconds after the one before.
  Expected<SharedBytes> ask() {
    now_ += 2s;
    download_.tidy(now_);
    std::optional<Expected<SharedBytes>> got;
    download_.ask(now_, [&](const Expected<SharedBytes>& file) { got = file; });
    io_.restart();
    const auto busy = boost::asio::make_work_guard(io_);
    while (!got) io_.run_one();
    return *got;
  }

  boost::asio::io_context io_;
  MapModel model_ = small_world();
  int made_ = 0;
  MapSaver saver_ = [this](const BlockMap&) {
    return std::vector<std::uint8_t>(kFile_bytes, static_cast<std::uint8_t>(++made_));
  };
  MapDownload::Time now_{};
  MapDownload download_{io_, model_, saver_, kBudget_bytes};
};

TEST_F(SlowDownloads, hold_no_more_memory_than_their_share) {
  std::vector<SharedBytes> held;
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    if (auto file = ask()) {
      held.push_back(*file);
    } else {
      EXPECT_EQ(file.error().code, ErrorCode::kOutOfMemory);
      ++refused;
    }
    EXPECT_LE(download_.held_bytes(), kBudget_bytes);
  }
  EXPECT_EQ(held.size(), 3U);
  EXPECT_EQ(refused, 57);
  held.erase(held.begin());  // one has taken its own
  EXPECT_TRUE(ask());
}

TEST_F(SlowDownloads, are_given_one_file_however_large) {
  MapDownload narrow(io_, model_, saver_, 1);
  std::optional<Expected<SharedBytes>> got;
  narrow.ask(now_, [&](const Expected<SharedBytes>& file) { got = file; });
  const auto busy = boost::asio::make_work_guard(io_);
  while (!got) io_.run_one();
  EXPECT_TRUE(*got);
}

}  // namespace
}  // namespace swiftlet::station
#endif
