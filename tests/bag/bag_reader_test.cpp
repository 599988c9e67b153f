// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/bag_reader.hpp"

#include <bzlib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "support/bag_writer.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/bag/chunk_codec.hpp"

namespace swiftlet {
namespace {

using test::Bytes;
using ::testing::HasSubstr;

std::vector<std::byte> as_bytes(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// What a reader gave until its end or its first error.
struct Reading {
  std::vector<std::string> messages;  // "topic time data"
  std::string error;
};

Reading read_all(std::string_view bag) {
  Reading reading;
  auto reader = BagReader::open(std::make_unique<MemoryBytes>(as_bytes(bag), "test.bag"));
  if (!reader) {
    reading.error = reader.error().text();
    return reading;
  }
  while (true) {
    const auto message = reader->next();
    if (!message) reading.error = message.error().text();
    if (!message || !*message) break;
    const std::string_view data(reinterpret_cast<const char*>((*message)->data.data()),
                                (*message)->data.size());
    reading.messages.push_back(
        fmt::format("{} {} {}", (*message)->connection->topic, (*message)->record_time.ns, data));
  }
  const auto after = reader->next();
  EXPECT_TRUE(after && !*after) << "after an end or an error there is nothing more";
  return reading;
}

/// Four chunks of five messages, and where each chunk ends.
struct SmallBag {
  std::string bag;
  std::vector<std::size_t> ends;
  std::vector<std::string> messages;
};

SmallBag small_bag(const std::string& compression) {
  SmallBag small;
  test::BagWriter writer(compression);
  small.ends.push_back(writer.bag().size());
  for (int i = 0; i < 20; ++i) {
    const std::string topic = i % 3 == 0 ? "/a" : "/b";
    const std::string data = fmt::format("message {} {}", i, std::string(50, 'x'));
    const Stamp time{1'000'000'007LL * i};
    writer.message(topic, "std_msgs/String", time, data);
    small.messages.push_back(fmt::format("{} {} {}", topic, time.ns, data));
    if (i % 5 == 4) small.ends.push_back(writer.end_chunk());
  }
  small.bag = writer.bag();
  return small;
}

class EveryCompression : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Bag, EveryCompression, ::testing::Values("none", "lz4"));

TEST_P(EveryCompression, is_read_message_by_message_in_the_order_of_the_file) {
  const SmallBag small = small_bag(GetParam());
  const Reading reading = read_all(small.bag);
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.messages, small.messages);
}

TEST_P(EveryCompression, cut_at_any_byte_gives_the_whole_chunks_before_and_says_where) {
  const SmallBag small = small_bag(GetParam());
  for (std::size_t bytes = 0; bytes < small.bag.size(); ++bytes) {
    const Reading reading = read_all(std::string_view(small.bag).substr(0, bytes));
    const auto whole = static_cast<std::size_t>(
        std::ranges::count_if(small.ends, [&](std::size_t end) { return end <= bytes; }));
    const std::size_t expected = whole == 0 ? 0 : 5 * (whole - 1);
    ASSERT_EQ(reading.messages.size(), expected) << "cut at " << bytes;
    const bool is_at_a_boundary = std::ranges::find(small.ends, bytes) != small.ends.end() ||
                                  bytes == std::strlen("#ROSBAG V2.0\n");
    ASSERT_EQ(reading.error.empty(), is_at_a_boundary) << "cut at " << bytes;
    if (!reading.error.empty()) {
      ASSERT_THAT(reading.error, HasSubstr("test.bag"));
    }
  }
}

TEST_P(EveryCompression, with_a_flipped_bit_never_does_harm) {
  const SmallBag small = small_bag(GetParam());
  std::size_t noticed = 0;
  for (std::size_t bit = 0; bit < 8 * small.bag.size(); ++bit) {
    std::string bag = small.bag;
    bag[bit / 8] = static_cast<char>(bag[bit / 8] ^ (1 << (bit % 8)));
    const Reading reading = read_all(bag);
    noticed += reading.error.empty() ? 0 : 1;
    ASSERT_LE(reading.messages.size(), small.messages.size());
  }
  // LZ4 frames carry a checksum; without one only the structure can tell.
  const double share = static_cast<double>(noticed) / static_cast<double>(8 * small.bag.size());
  EXPECT_GT(share, GetParam() == "lz4" ? 0.5 : 0.1);
}

TEST_P(EveryCompression, full_of_noise_never_does_harm) {
  const std::string bag = small_bag(GetParam()).bag;
  test::for_each_seed(500, [&](test::Random& random) {
    std::string noisy = bag;
    for (int i = 0; i < 20; ++i) {
      noisy[random.integer<std::size_t>(13, noisy.size() - 1)] =
          static_cast<char>(random.integer(0, 255));
    }
    (void)read_all(noisy);
  });
}

TEST(Bag, packed_by_lz4_with_a_flipped_bit_is_noticed_or_unpacks_to_the_same) {
  const SmallBag small = small_bag("lz4");
  const std::size_t begin = small.bag.find("\x04\x22\x4d\x18");  // magic of an LZ4 frame
  ASSERT_NE(begin, std::string::npos);
  for (std::size_t bit = 8 * (begin + 15); bit < 8 * small.ends[1]; ++bit) {
    std::string bag = small.bag;
    bag[bit / 8] = static_cast<char>(bag[bit / 8] ^ (1 << (bit % 8)));
    const Reading reading = read_all(bag);  // a copy of 'x' may come from another place: no harm
    EXPECT_TRUE(!reading.error.empty() || reading.messages == small.messages) << bit;
  }
}

TEST(Bag, of_another_kind_is_refused_by_name) {
  EXPECT_THAT(read_all("").error, HasSubstr("it is no ROS bag"));
  EXPECT_THAT(read_all("SQLite format 3").error, HasSubstr("it is no ROS bag"));
  EXPECT_THAT(read_all("#ROSBAG V1.2\n").error, HasSubstr("another version"));
  EXPECT_THAT(open_file_bytes("/dev/null").error().text(), HasSubstr("it is not a file"));
  EXPECT_THAT(open_file_bytes("/no/such.bag").error().text(), HasSubstr("no such file"));
}

TEST(Bag, that_lies_about_the_size_of_a_chunk_does_not_get_the_memory) {
  std::vector<std::byte> out;
  const std::string text = "not compressed at all";
  const auto fault = unpack_chunk("lz4", as_bytes(text), kMaxChunkBytes, out);
  EXPECT_TRUE(fault);
  EXPECT_LT(out.capacity(), 2U << 20U);
  EXPECT_TRUE(unpack_chunk("none", as_bytes(text), kMaxChunkBytes + 1, out));
  EXPECT_THAT(unpack_chunk("zip", as_bytes(text), 21, out).value_or(""), HasSubstr("'zip'"));
}

TEST(Bag, packed_by_bzip2_is_read_too_and_a_bomb_stops_at_its_promise) {
  const std::string text(300'000, 'b');
  std::string packed(1000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  ASSERT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(text.data()),
                                     static_cast<unsigned>(text.size()), 9, 0, 0),
            BZ_OK);
  packed.resize(size);
  std::vector<std::byte> out;
  EXPECT_EQ(unpack_chunk("bz2", as_bytes(packed), 300'000, out), std::nullopt);
  EXPECT_EQ(out, as_bytes(text));
  EXPECT_TRUE(unpack_chunk("bz2", as_bytes(packed), 1000, out)) << "longer than promised";
  EXPECT_LE(out.size(), 1001U);
  EXPECT_TRUE(unpack_chunk("bz2", as_bytes(packed), 300'001, out)) << "shorter than promised";
  EXPECT_TRUE(unpack_chunk("bz2", as_bytes(packed.substr(0, size / 2)), 300'000, out));
}

TEST(Bag, of_bzip2_bombs_is_refused_before_it_takes_its_time) {
  const std::string zeros =  // one record, which a reader passes over
      test::BagWriter::record(test::BagWriter::field("op", "\x04"), std::string(8U << 20U, '\0'));
  std::string packed(10'000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  ASSERT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(zeros.data()),
                                     static_cast<unsigned>(zeros.size()), 9, 0, 0),
            BZ_OK);
  packed.resize(size);
  std::string bag = test::BagWriter().bag();
  for (int i = 0; i < 1000; ++i) {
    bag += test::BagWriter::record(
        test::BagWriter::field("op", "\x05") + test::BagWriter::field("compression", "bz2") +
            test::BagWriter::field(
                "size", test::Bytes().add(static_cast<std::uint32_t>(zeros.size())).text()),
        packed);
  }
  const std::string error = read_all(bag).error;
  EXPECT_THAT(error, HasSubstr("bzip2"));
  EXPECT_THAT(error, HasSubstr("rosbag decompress"));
}

}  // namespace
}  // namespace swiftlet
