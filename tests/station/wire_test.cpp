// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/page/wire.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "station/station_world.hpp"
#include "station/wire_reader.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/station/page/client_message.hpp"

namespace swiftlet::station {
namespace {

/// The files that the page's own tests read, too (web/tests/unit/golden.test.ts).
void expect_golden(const std::string& name, const Bytes& bytes) {
  const std::string path = SWIFTLET_SOURCE_DIR "/tests/golden/station/" + name;
  const std::string text(bytes.begin(), bytes.end());
  if (std::getenv("SWIFTLET_WRITE_GOLDEN") != nullptr) test::write_file(path, text);
  EXPECT_EQ(text, test::content_of(path)) << "SWIFTLET_WRITE_GOLDEN=1 writes the files anew";
}

VoxelBlock ramp_block(int first) {
  VoxelBlock block;
  for (std::size_t i = 0; i < block.voxels.size(); ++i) {
    block.voxels[i] = static_cast<QuantizedLogOdds>(first + static_cast<int>(i / 2));
  }
  return block;
}

MapMirror golden_map() {
  MapMirror map;
  map.put({-3, 2, 1}, ramp_block(0), 1);
  map.put({-2, 2, 1}, ramp_block(7), 1);
  return map;
}

TEST(Wire, hello_is_the_golden_file) {
  const std::string text = hello_text(small_info(), 3);
  expect_golden("hello.json", Bytes(text.begin(), text.end()));
}

TEST(Wire, blocks_are_the_golden_file) {
  const MapMirror map = golden_map();
  BlockPacker packer;
  const Bytes message =
      packer.blocks_message({17, 3}, {{{-3, 2, 1}, {5, 5, 5}, {-2, 2, 1}}, true}, map);
  WireReader reader;
  reader.blocks[{5, 5, 5}] = ramp_block(1);
  reader.read(message);
  EXPECT_EQ(reader.digest({}), map.digest());
  expect_golden("blocks.bin", message);
}

TEST(Wire, frames_are_the_golden_file) {
  FrameReport frame;
  frame.stamp = Stamp{1'700'000'000'123'456'789};
  frame.number = 42;
  frame.verdict = 1;
  frame.camera = 2;
  frame.has_shifted = true;
  frame.T_world_camera = Transform<World, Camera>::trusted(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5),
                                                           {1.25, -2.5, 1e6 - 0.125});
  frame.stage_ms = {0.25F, 0.5F, 4.0F, 0.125F};
  frame.readings = 400'000;
  frame.voxels = 12'345;
  frame.blocks_left = 3;
  frame.intrinsics = *PinholeIntrinsics::create(848, 480, 425.5, 426.5, 423.25, 239.75);
  frame.lost = {4, 5, 0, 0, 0, 0, 0, 0};
  FrameReport bare;
  bare.number = 43;
  expect_golden("frames.bin", frames_message({18, 3}, std::vector<FrameReport>{frame, bare}));
}

TEST(Wire, status_is_the_golden_file) {
  StatusReport status;
  status.state = FlightState::kFlying;
  status.window = {{-5, 6, -7}, {27, 28, 9}};
  status.trigger_centre_m = {0.5, -1.5, 2.5};
  status.frame_count = 5'000'000'000;
  status.memory_bytes = 12'345'678'901;
  status.blocks = 1;
  status.pending = 2;
  status.clients = 3;
  status.rate_limit = 125'000;
  status.reports_missed = 4;
  status.verdicts = {100, 7};
  status.losses = {8, 9, 10};
  expect_golden("status.bin", status_message({19, 3}, status));
}

TEST(Wire, checksum_is_the_golden_file) {
  expect_golden("checksum.bin", checksum_message({20, 3}, 99, golden_map().digest()));
}

TEST(Wire, course_is_the_golden_file) {
  Course course;
  course.frame_count = 5'000'000'001;
  course.goal_m = {8.5, 1.75, 1.25};
  course.target_m = {2.5, -0.5, 1.0};
  course.path = {{{1.0, 0.5, 1.25}, 0.75}, {{2.5, -0.5, 1.0}, 0.25}};
  course.frontier = {{{3.0, -1.0, 0.5}, 321}};
  expect_golden("course.bin", course_message({21, 3}, course));
}

TEST(Wire, a_course_without_end_is_told_in_part) {
  Course course;
  course.path.resize(100'000);
  course.frontier.resize(100'000);
  EXPECT_EQ(course_message({0, 1}, course).size(), 64U + 2 * 4096 * 16);
}

TEST(Wire, a_source_whose_name_is_no_text_does_not_break_the_hello) {
  MapInfo info = small_info();
  info.source = "map\xff\xfe.swl";
  EXPECT_NE(hello_text(info, 1).find("map"), std::string::npos);
}

TEST(BlockHash, differs_with_every_voxel_and_every_coordinate) {
  const VoxelBlock block = ramp_block(0);
  const auto hash = block_hash({1, 2, 3}, block, 0);
  EXPECT_NE(hash, block_hash({1, 2, 3}, block, 1));
  EXPECT_NE(hash, block_hash({2, 1, 3}, block, 0));
  for (std::size_t i = 0; i < block.voxels.size(); ++i) {
    VoxelBlock other = block;
    other.voxels[i] ^= 1;
    EXPECT_NE(hash, block_hash({1, 2, 3}, other, 0));
  }
}

TEST(ClientMessage, reads_what_clients_may_say) {
  const auto parse = [](Bytes bytes) { return parse_client_message(bytes); };
  const auto resend = parse({1, 0, 0, 0, 5, 1, 0, 0, 6, 1, 0, 0});
  ASSERT_TRUE(resend);
  EXPECT_EQ(std::get<Resend>(*resend).first, 261U);
  EXPECT_EQ(std::get<Resend>(*resend).last, 262U);
  EXPECT_TRUE(std::holds_alternative<SendAll>(*parse({2, 0, 0, 0})));
  EXPECT_EQ(std::get<SetPace>(*parse({3, 2, 0, 0})).pace, Pace::kStep);
  EXPECT_EQ(std::get<SetRate>(*parse({4, 0, 0, 0, 0, 0, 1, 0})).bytes_per_s, 65536U);
}

TEST(ClientMessage, refuses_every_other_length_type_and_value) {
  test::Random random;
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes(random.integer<std::size_t>(0, 16));
    for (auto& byte : bytes) {
      byte = static_cast<std::uint8_t>(random.chance(0.7) ? random.integer(0, 5)
                                                          : random.integer(0, 255));
    }
    const auto message = parse_client_message(bytes);
    if (!message) continue;
    constexpr std::array<std::size_t, 4> kLengths{12, 4, 4, 8};
    EXPECT_EQ(bytes.size(), kLengths.at(message->index())) << random.repeat();
  }
  for (const int type : {0, 5, 255}) {
    EXPECT_FALSE(parse_client_message(Bytes{static_cast<std::uint8_t>(type), 0, 0, 0}));
  }
  EXPECT_FALSE(parse_client_message(Bytes{3, 3, 0, 0}));
}

}  // namespace
}  // namespace swiftlet::station
