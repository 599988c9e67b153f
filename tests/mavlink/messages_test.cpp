// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/wire/messages.hpp"

#include <gtest/gtest.h>

#include <map>

#include "mavlink/random_message.hpp"

namespace swiftlet::mavlink {
namespace {

struct Published {
  std::uint32_t id;
  std::uint8_t crc_extra;
  std::size_t length, base_length;
};

/// As the public dialects' generated C library has them (mavlink/c_library_v2 of 2026-08-22).
const std::map<std::string_view, Published> kPublished{
    {"HEARTBEAT", {0, 50, 9, 9}},
    {"SYSTEM_TIME", {2, 137, 12, 12}},
    {"PARAM_REQUEST_READ", {20, 214, 20, 20}},
    {"PARAM_VALUE", {22, 220, 25, 25}},
    {"ATTITUDE_QUATERNION", {31, 246, 48, 32}},
    {"LOCAL_POSITION_NED", {32, 185, 28, 28}},
    {"COMMAND_LONG", {76, 152, 33, 33}},
    {"COMMAND_ACK", {77, 143, 10, 3}},
    {"VISION_POSITION_ESTIMATE", {102, 158, 117, 32}},
    {"VISION_SPEED_ESTIMATE", {103, 208, 57, 20}},
    {"HIGHRES_IMU", {105, 93, 63, 62}},
    {"TIMESYNC", {111, 34, 18, 16}},
    {"DISTANCE_SENSOR", {132, 85, 39, 14}},
    {"STATUSTEXT", {253, 83, 54, 51}},
    {"OBSTACLE_DISTANCE", {330, 23, 167, 158}},
    {"ODOMETRY", {331, 91, 233, 230}},
    {"OBSTACLE_DISTANCE_3D", {11037, 130, 28, 28}},
};

TEST(Messages, have_the_numbers_lengths_and_checksums_that_are_published) {
  std::size_t compared = 0;
  for_each_message([&]<class Message>(const Message&) {
    const Published& published = kPublished.at(Message::kName);
    EXPECT_EQ(Message::kId, published.id) << Message::kName;
    EXPECT_EQ(crc_extra_of<Message>(), published.crc_extra) << Message::kName;
    EXPECT_EQ(length_of<Message>(), published.length) << Message::kName;
    EXPECT_EQ(base_length_of<Message>(), published.base_length) << Message::kName;
    ASSERT_NE(find_message(Message::kId), nullptr);
    EXPECT_EQ(find_message(Message::kId)->name, Message::kName);
    EXPECT_EQ(find_message(Message::kId)->crc_extra, published.crc_extra);
    ++compared;
  });
  EXPECT_EQ(compared, kPublished.size());
  EXPECT_EQ(find_message(1), nullptr);
  EXPECT_EQ(find_message(0xFFFFFF), nullptr);
}

TEST(Messages, keep_every_field_through_their_payload) {
  test::for_each_seed(50, [](test::Random& random) {
    for_each_message([&]<class Message>(const Message&) {
      const auto message = test::random_message<Message>(random);
      Payload payload{};
      const std::size_t length = pack(message, payload);
      ASSERT_GE(length, 1U);
      ASSERT_LE(length, length_of<Message>());
      ASSERT_TRUE(length == 1 || payload[length - 1] != 0) << Message::kName;
      ASSERT_EQ(test::text_of_message(unpack<Message>(payload)), test::text_of_message(message));
    });
  });
}

TEST(Messages, put_unaligned_extension_fields_where_the_wire_has_them) {
  ObstacleDistance message;
  message.increment_f = -1.5F;
  message.angle_offset = 2.25F;
  message.frame = 12;
  Payload payload{};
  ASSERT_EQ(pack(message, payload), 167U);
  EXPECT_EQ(layout::load<float>(&payload[158]), -1.5F);
  EXPECT_EQ(layout::load<float>(&payload[162]), 2.25F);
  EXPECT_EQ(payload[166], 12);
}

TEST(Checksum, is_that_of_the_algorithm_s_catalogue_entry) {
  std::uint16_t crc = kCrcStart;
  for (const char c : std::string_view("123456789"))
    crc = crc_with(crc, static_cast<std::uint8_t>(c));
  EXPECT_EQ(crc, 0x6F91);  // CRC-16/MCRF4XX, check value
}

}  // namespace
}  // namespace swiftlet::mavlink
