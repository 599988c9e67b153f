// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include "mavlink/peer/node_peer.hpp"
#include "mavlink/random_message.hpp"
#include "swiftlet/mavlink/wire/packet_parser.hpp"
#include "swiftlet/mavlink/wire/packet_writer.hpp"

namespace swiftlet::mavlink {
namespace {

using test::NodePeer;

constexpr std::size_t kMessages = 100'000;
constexpr std::size_t kPerKind = kMessages / 2 / std::tuple_size_v<Messages> + 1;
constexpr std::size_t kInFlight = 20;  // fits into a socket's buffer

TEST(NodeMavlink, reads_every_field_of_every_message_that_is_written_here) {
  if (const std::string why = NodePeer::missing(); !why.empty()) GTEST_SKIP() << why;
  const NodePeer peer;
  test::Random random;
  PacketWriter writer({1, 197});
  std::size_t compared = 0;
  for_each_message([&]<class Message>(const Message&) {
    for (std::size_t sent = 0; sent < kPerKind; sent += kInFlight) {
      std::vector<std::string> texts;
      for (std::size_t i = 0; i < kInFlight; ++i) {
        const auto message = test::random_message<Message>(random);
        texts.push_back(test::text_of_message(message));
        peer.send(writer.write(message, {}).bytes());
      }
      for (const std::string& text : texts) {
        ASSERT_EQ(peer.receive(), text) << random.repeat();
        ++compared;
      }
    }
  });
  EXPECT_GE(compared, kMessages / 2);
}

TEST(NodeMavlink, writes_every_field_of_every_message_so_that_it_is_read_here) {
  if (const std::string why = NodePeer::missing(); !why.empty()) GTEST_SKIP() << why;
  const NodePeer peer;
  PacketParser parser;
  std::size_t compared = 0;
  for_each_message([&]<class Message>(const Message&) {
    for (std::size_t asked = 0; asked < kPerKind; asked += kInFlight) {
      peer.send(std::to_string(kInFlight) + ' ' + std::string(Message::kName));
      for (std::size_t i = 0; i < kInFlight; ++i) {
        const std::string datagram = peer.receive();
        const std::size_t text = datagram.rfind(std::string(Message::kName) + ' ');
        ASSERT_NE(text, std::string::npos);
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(datagram.data());
        std::string read;
        parser.feed({bytes, text}, {}, [&](const Packet& packet) {
          if (const auto message = packet.as<Message>()) read = test::text_of_message(*message);
        });
        ASSERT_EQ(read, datagram.substr(text));
        ++compared;
      }
    }
  });
  EXPECT_GE(compared, kMessages / 2);
  EXPECT_EQ(parser.tally().skipped_bytes, 0U);
  EXPECT_EQ(parser.tally().bad_checksums, 0U);
}

}  // namespace
}  // namespace swiftlet::mavlink
