// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The map as a file, over real sockets; what the program writes into it is tested in tests/app/.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <latch>

#include "station/requests.hpp"
#include "station/served_flight.hpp"

#if SWIFTLET_HAS_VIEW
namespace swiftlet::station {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A map file of the simplest kind: after the frames, each block's index and voxels.
std::vector<std::uint8_t> plain_file(const BlockMap& map) {
  std::vector<std::uint8_t> bytes(8);
  std::memcpy(bytes.data(), &map.header().frame_count, 8);
  for (const BlockIndex& index : map.sorted_blocks()) {
    const VoxelBlock& block = *map.find(index);
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(index) + kBlockVoxels);
    std::memcpy(bytes.data() + at, &index, sizeof(index));
    std::ranges::copy(block.voxels,
                      bytes.begin() + static_cast<std::ptrdiff_t>(at + sizeof(index)));
  }
  return bytes;
}

MapDigest digest_of(std::string_view file) {
  MapMirror map(small_info().header);
  for (std::size_t at = 8; at < file.size(); at += sizeof(BlockIndex) + kBlockVoxels) {
    BlockIndex index;
    VoxelBlock block;
    std::memcpy(&index, file.data() + at, sizeof(index));
    std::memcpy(block.voxels.data(), file.data() + at + sizeof(index), kBlockVoxels);
    map.put(index, block, 1);
  }
  return map.digest();
}

class DownloadedMap : public ServedFlight {
 protected:
  void start(MapSaver saver, const std::string& token = "", std::size_t max_downloads = 16) {
    StationOptions options;
    options.access.token = token;
    options.save_map = std::move(saver);
    options.max_downloads = max_downloads;
    serve(options);
  }
  /// Asks until the station has seen the whole flight, which it looks at in its own time.
  std::string body_of_whole_map() const {
    for (;;) {
      const std::string said = answer_to(get(port_, "", "/map.swl"));
      const auto end = said.find("\r\n\r\n");
      const std::string body = end == std::string::npos ? "" : said.substr(end + 4);
      if (body.size() < 8 || digest_of(body) == flight_.truth()) return body;
    }
  }
};

TEST_F(DownloadedMap, is_the_whole_map_as_of_one_frame) {
  for (int i = 0; i < 60; ++i) flight_.step();
  start(plain_file);
  while (!answer_to(get(port_, "", "/map.swl")).starts_with("HTTP/1.1 200")) continue;  // not yet
  const std::string body = body_of_whole_map();
  std::uint64_t frames = 0;
  ASSERT_GE(body.size(), 8U);
  std::memcpy(&frames, body.data(), 8);
  EXPECT_EQ(frames, 60U);
  EXPECT_EQ(digest_of(body), flight_.truth());
  EXPECT_THAT(answer_to(get(port_, "", "/map.swl")),
              HasSubstr("Content-Disposition: attachment; filename=\"map.swl\"\r\n"));
}

TEST_F(DownloadedMap, is_only_for_who_may_look_and_asks_by_himself) {
  flight_.step();
  start(plain_file, "s3cret-token");
  const std::string known = "/map.swl?token=s3cret-token";
  for (const std::string& request :
       {get(port_, "", "/map.swl"), get(port_, "", "/map.swl?token=s3cret-tokex"),
        get(port_, "Origin: http://evil.example\r\n", known),
        get(port_, "Sec-Fetch-Site: cross-site\r\n", known)}) {
    const std::string said = answer_to(request);
    EXPECT_THAT(said, testing::ContainsRegex("^HTTP/1.1 40[13] ")) << request;
    EXPECT_THAT(said, HasSubstr("Content-Type: text/plain")) << request;
  }
  std::string head = get(port_, "", known);
  head.replace(0, 3, "HEAD");
  EXPECT_THAT(answer_to(head), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answer_to(get(port_, "Sec-Fetch-Site: same-origin\r\n", known)),
              testing::ContainsRegex("^HTTP/1.1 (200|404) "));  // 404: not looked at yet
}

TEST_F(DownloadedMap, is_made_once_for_all_who_ask_meanwhile_and_holds_up_nobody_else) {
  flight_.step();
  std::atomic<int> files = 0;
  std::latch is_asked{1};
  std::latch may_go_on{1};
  start([&](const BlockMap& map) -> Expected<std::vector<std::uint8_t>> {
    if (++files == 1) {
      is_asked.count_down();
      may_go_on.wait();
    }
    return plain_file(map);
  });
  // The page comes whatever the worker does; when a socket is let in, the map has been looked at.
  RawSocket client(port_);
  client.send(upgrade(port_));
  EXPECT_THAT(client.receive_head(), StartsWith("HTTP/1.1 101"));
  while (client.next_message().first == 1) continue;  // the hello; then the map
  std::vector<std::unique_ptr<RawSocket>> asking;
  for (int i = 0; i < 10; ++i) {
    asking.push_back(std::make_unique<RawSocket>(port_));
    asking.back()->send(get(port_, "", "/map.swl"));
  }
  is_asked.wait();
  EXPECT_THAT(answer_to(get(port_)), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(files, 1);
  may_go_on.count_down();
  std::string first;
  for (const auto& socket : asking) {
    const std::string said = socket->receive_all();
    EXPECT_THAT(said, StartsWith("HTTP/1.1 200"));
    if (first.empty()) first = said;
    EXPECT_EQ(said, first);
  }
}

TEST_F(DownloadedMap, leaves_room_for_others_and_says_when_to_come_back) {
  flight_.step();
  std::latch is_asked{1};
  std::latch may_go_on{1};
  start(
      [&](const BlockMap& map) -> Expected<std::vector<std::uint8_t>> {
        is_asked.count_down();
        may_go_on.wait();
        return plain_file(map);
      },
      "", 1);
  RawSocket client(port_);
  client.send(upgrade(port_));
  EXPECT_THAT(client.receive_head(), StartsWith("HTTP/1.1 101"));
  while (client.next_message().first == 1) continue;  // the hello; then the map
  RawSocket first(port_);
  first.send(get(port_, "", "/map.swl"));
  is_asked.wait();
  const std::string second = answer_to(get(port_, "", "/map.swl"));
  may_go_on.count_down();
  EXPECT_THAT(second, StartsWith("HTTP/1.1 503"));
  EXPECT_THAT(second, HasSubstr("Retry-After: 5"));
  EXPECT_THAT(first.receive_all(), StartsWith("HTTP/1.1 200"));
}

TEST_F(DownloadedMap, says_that_nothing_has_been_mapped_yet) {
  start(plain_file);
  EXPECT_THAT(answer_to(get(port_, "", "/map.swl")), HasSubstr("nothing has been mapped yet"));
}

TEST_F(DownloadedMap, says_that_this_station_has_none_to_give) {
  start({});
  EXPECT_THAT(answer_to(get(port_, "", "/map.swl")), StartsWith("HTTP/1.1 500"));
}

TEST_F(DownloadedMap, says_why_it_could_not_be_made) {
  flight_.step();
  start([](const BlockMap&) -> Expected<std::vector<std::uint8_t>> {
    return fail(ErrorCode::kIo, "/tmp/map.swl", "the disk is full", "make room");
  });
  std::string said;
  do {
    said = answer_to(get(port_, "", "/map.swl"));
  } while (said.starts_with("HTTP/1.1 404"));  // not looked at yet
  EXPECT_THAT(said, StartsWith("HTTP/1.1 500"));
  EXPECT_THAT(said, HasSubstr("/tmp/map.swl: the disk is full; make room"));
}

TEST_F(DownloadedMap, does_not_keep_the_station_from_ending) {
  flight_.step();
  std::latch is_asked{1};
  start([&](const BlockMap& map) -> Expected<std::vector<std::uint8_t>> {
    is_asked.count_down();
    return plain_file(map);
  });
  RawSocket client(port_);
  client.send(upgrade(port_));
  EXPECT_THAT(client.receive_head(), StartsWith("HTTP/1.1 101"));
  while (client.next_message().first == 1) continue;
  RawSocket socket(port_);
  socket.send(get(port_, "", "/map.swl"));
  is_asked.wait();
  station_.reset();
}

}  // namespace
}  // namespace swiftlet::station
#endif
