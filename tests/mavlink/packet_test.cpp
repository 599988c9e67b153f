// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <vector>

#include "mavlink/random_message.hpp"
#include "swiftlet/mavlink/wire/packet_parser.hpp"
#include "swiftlet/mavlink/wire/packet_writer.hpp"

namespace swiftlet::mavlink {
namespace {

using test::bytes_of_hex;
using Bytes = std::vector<std::uint8_t>;

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void flip(Bytes& bytes, std::size_t bit) {
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << bit % 8));
}

Bytes bytes_of(const WireFrame& frame) { return {frame.bytes().begin(), frame.bytes().end()}; }

std::vector<Packet> parsed(PacketParser& parser, std::span<const std::uint8_t> bytes) {
  std::vector<Packet> packets;
  parser.feed(bytes, Stamp{}, [&](const Packet& packet) { packets.push_back(packet); });
  return packets;
}

// Frames of system 42, component 196, written by node-mavlink 2.3.0.
constexpr std::string_view kHeartbeat = "fd090000002ac400000004030201120800040300ac";
constexpr std::string_view kOdometry =
    "fde90000022ac44b01004d000000000000000000c03f000010c00000003e0000003f0000003f000000bf0000"
    "003fcdcccc3d00000000000040c000000000000000000000803e000000000000003e0000803e0000c03e0000"
    "003f0000203f0000403f0000603f0000803f0000903f0000a03f0000b03f0000c03f0000d03f0000e03f0000"
    "f03f00000040000008400000104000001840000020400000c07f000000000000000000000000000000000000"
    "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
    "000000000000000000000000000000000000140c0703ff9590";
constexpr std::string_view kStatusText = "fd0d0000032ac4fd0000026d6170206973207374616c65a954";
constexpr std::string_view kTimesync = "fd100000042ac46f00000000000000000000fbffffffffffffffc1d1";

Heartbeat heartbeat() {
  return {
      .custom_mode = 0x01020304, .type = 18, .autopilot = 8, .base_mode = 0, .system_status = 4};
}

TEST(PacketWriter, writes_the_frames_that_another_library_writes) {
  PacketWriter writer({42, 196});
  EXPECT_EQ(bytes_of(writer.write(heartbeat(), {})), bytes_of_hex(kHeartbeat));
  (void)writer.write(heartbeat(), {});
  Odometry odometry{.time_usec = 77,
                    .x = 1.5F,
                    .y = -2.25F,
                    .z = 0.125F,
                    .q = {.5F, .5F, -.5F, .5F},
                    .vx = 0.1F,
                    .vz = -3,
                    .yawspeed = 0.25F};
  for (std::size_t i = 0; i < 21; ++i) odometry.pose_covariance[i] = static_cast<float>(i) / 8;
  odometry.velocity_covariance[0] = std::bit_cast<float>(0x7FC00000U);
  odometry.frame_id = 20;
  odometry.child_frame_id = 12;
  odometry.reset_counter = 7;
  odometry.estimator_type = 3;
  odometry.quality = -1;
  EXPECT_EQ(bytes_of(writer.write(odometry, {})), bytes_of_hex(kOdometry));
  StatusText text{.severity = 2};
  std::ranges::copy(std::string_view("map is stale"), text.text.begin());
  EXPECT_EQ(bytes_of(writer.write(text, {})), bytes_of_hex(kStatusText));
  EXPECT_EQ(bytes_of(writer.write(Timesync{.ts1 = -5}, {})), bytes_of_hex(kTimesync));
}

TEST(PacketWriter, cuts_zeros_at_the_end_but_leaves_one_byte) {
  PacketWriter writer({1, 1});
  EXPECT_EQ(writer.write(SystemTime{}, {}).bytes().size(),
            wire::kHeaderBytes + 1 + wire::kCrcBytes);
}

TEST(PacketParser, reads_the_frames_that_another_library_writes) {
  PacketParser parser;
  const auto packets = parsed(parser, joined({bytes_of_hex(kHeartbeat), bytes_of_hex(kOdometry),
                                              bytes_of_hex(kStatusText), bytes_of_hex(kTimesync)}));
  ASSERT_EQ(packets.size(), 4U);
  EXPECT_EQ(packets[0].from, (Address{42, 196}));
  EXPECT_EQ(packets[0].as<Heartbeat>()->custom_mode, 0x01020304U);
  EXPECT_EQ(packets[0].as<Heartbeat>()->mavlink_version, 3);
  EXPECT_FALSE(packets[0].as<Odometry>());
  EXPECT_EQ(packets[1].sequence, 2);
  EXPECT_EQ(packets[1].as<Odometry>()->quality, -1);
  EXPECT_EQ(packets[1].as<Odometry>()->pose_covariance[20], 2.5F);
  EXPECT_EQ(std::string_view(packets[2].as<StatusText>()->text.data()), "map is stale");
  EXPECT_EQ(packets[3].as<Timesync>()->ts1, -5);
  EXPECT_EQ(parser.tally().skipped_bytes, 0U);
}

TEST(PacketParser, finds_every_frame_however_the_stream_is_cut_and_whatever_lies_between) {
  test::for_each_seed(20, [](test::Random& random) {
    PacketWriter writer({9, 9});
    Bytes stream;
    std::vector<std::string> sent, received;
    for (int i = 0; i < 50; ++i) {
      for (int junk = random.integer(0, 5); junk > 0; --junk)
        stream.push_back(static_cast<std::uint8_t>(random.integer(0, 0xFC)));
      const auto message = test::random_message<Odometry>(random);
      sent.push_back(test::text_of_message(message));
      const auto frame = writer.write(message, {});
      stream.insert(stream.end(), frame.bytes().begin(), frame.bytes().end());
    }
    PacketParser parser;
    for (std::size_t at = 0; at < stream.size();) {
      const auto count = std::min<std::size_t>(random.integer(1, 700), stream.size() - at);
      for (const Packet& packet : parsed(parser, std::span(stream).subspan(at, count)))
        received.push_back(test::text_of_message(*packet.as<Odometry>()));
      at += count;
    }
    EXPECT_EQ(received, sent);
  });
}

TEST(PacketParser, lets_no_frame_with_a_changed_bit_pass) {
  Bytes frame = bytes_of_hex(kStatusText);
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Bytes changed = frame;
    flip(changed, bit);
    PacketParser parser;
    EXPECT_TRUE(parsed(parser, changed).empty()) << "bit " << bit;
  }
}

TEST(PacketParser, finds_the_frame_behind_a_broken_one) {
  Bytes broken = bytes_of_hex(kOdometry);
  flip(broken, 8 * 30);
  PacketParser parser;
  EXPECT_EQ(parsed(parser, joined({broken, bytes_of_hex(kHeartbeat)})).size(), 1U);
  EXPECT_EQ(parser.tally().bad_checksums, 1U);
  // One that was cut off and whose missing bytes are those of the next.
  Bytes cut = bytes_of_hex(kStatusText);
  cut.resize(15);
  const Bytes heartbeats = joined({bytes_of_hex(kHeartbeat), bytes_of_hex(kHeartbeat)});
  EXPECT_EQ(parsed(parser, joined({cut, heartbeats})).size(), 2U);
}

TEST(PacketParser, refuses_a_flag_that_it_must_understand_and_does_not) {
  for (const std::uint8_t flag : std::initializer_list<std::uint8_t>{0x02, 0x40, 0x80}) {
    Bytes frame = bytes_of_hex(kHeartbeat);
    frame[wire::kMustUnderstand] = flag;
    const std::size_t end = frame.size() - 2;
    const auto crc = crc_with(crc_with(kCrcStart, std::span(frame).subspan(1, end - 1)),
                              crc_extra_of<Heartbeat>());
    layout::store(crc, &frame[end]);
    PacketParser parser;
    EXPECT_TRUE(parsed(parser, frame).empty());
    EXPECT_EQ(parser.tally().unknown_flags, 1U);
  }
}

TEST(PacketParser, steps_over_messages_that_it_does_not_know_and_what_they_carry) {
  const Bytes carried = bytes_of_hex(kHeartbeat);
  Bytes tunnel{
      wire::kStart, static_cast<std::uint8_t>(carried.size()), 0, 0, 7, 1, 1, 0x81, 0x01, 0};
  tunnel.insert(tunnel.end(), carried.begin(), carried.end());
  tunnel.insert(tunnel.end(), {0, 0});
  PacketParser parser;
  EXPECT_EQ(parsed(parser, joined({tunnel, bytes_of_hex(kTimesync)})).size(), 1U);
  EXPECT_EQ(parser.tally().unknown_messages, 1U);
}

TEST(PacketParser, takes_fields_that_a_newer_dialect_has_added) {
  Bytes frame = bytes_of_hex(kHeartbeat);
  frame.resize(frame.size() - 2);
  frame.insert(frame.end(), {1, 2, 3});
  frame[wire::kLength] = static_cast<std::uint8_t>(frame[wire::kLength] + 3);
  const auto crc =
      crc_with(crc_with(kCrcStart, std::span(frame).subspan(1)), crc_extra_of<Heartbeat>());
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  PacketParser parser;
  const auto packets = parsed(parser, frame);
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].as<Heartbeat>()->mavlink_version, 3);
}

TEST(PacketParser, does_not_join_the_pieces_of_two_datagrams) {
  const Bytes frame = bytes_of_hex(kHeartbeat);
  PacketParser parser;
  EXPECT_TRUE(parsed(parser, std::span(frame).first(8)).empty());
  parser.start_anew();
  EXPECT_TRUE(parsed(parser, std::span(frame).subspan(8)).empty());
}

}  // namespace
}  // namespace swiftlet::mavlink
