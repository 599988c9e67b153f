// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Our reader against our writer, cut and damaged in every place. Files of others: recorded/ and
// tests/peers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>

#include <algorithm>
#include <cstring>

#include "support/bag_writer.hpp"
#include "support/memory_sink.hpp"
#include "support/seeds.hpp"
#include "swiftlet/bag/mcap/mcap_reader.hpp"
#include "swiftlet/bag/mcap/mcap_writer.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

struct McapReading {
  std::vector<std::string> messages{};  // "topic type time data"
  std::string error{};
  RecordingInfo info{};
};

McapReading read_mcap(std::string_view file) {
  McapReading reading;
  const auto bytes = std::as_bytes(std::span(file));
  auto reader = McapReader::open(std::make_unique<MemoryBytes>(
      std::vector<std::byte>(bytes.begin(), bytes.end()), "test.mcap"));
  if (!reader) {
    reading.error = reader.error().text();
    reading.info.is_closed = false;
    return reading;
  }
  while (true) {
    const auto message = reader->next();
    if (!message) reading.error = message.error().text();
    if (!message || !*message) break;
    const std::string_view data(reinterpret_cast<const char*>((*message)->data.data()),
                                (*message)->data.size());
    reading.messages.push_back(fmt::format("{} {} {} {}", (*message)->connection->topic,
                                           (*message)->connection->type, (*message)->record_time.ns,
                                           data));
  }
  const auto after = reader->next();
  EXPECT_TRUE(after && !*after) << "after an end or an error there is nothing more";
  reading.info = reader->info();
  return reading;
}

std::span<const std::uint8_t> as_data(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Four chunks of five messages, and where each chunk ends.
struct SmallMcap {
  std::string file;
  std::vector<std::size_t> ends;
  std::vector<std::string> messages;
};

SmallMcap small_mcap(bool is_packed) {
  SmallMcap small;
  const auto out = std::make_shared<std::string>();
  auto writer = McapWriter::create(std::make_unique<test::MemorySink>(out),
                                   {.chunk_bytes = 1U << 20U, .is_packed = is_packed});
  EXPECT_TRUE(writer);
  const auto a = writer->add_topic("/a", "std_msgs/msg/String", "ros2msg", "string data\n", "cdr");
  const auto b = writer->add_topic("/b", "std_msgs/msg/String", "ros2msg", "string data\n", "cdr");
  small.ends.push_back(out->size());
  for (int i = 0; i < 20; ++i) {
    const std::string data = fmt::format("message {} {}", i, std::string(50, 'x'));
    const Stamp time{1'000'000'007LL + i};
    EXPECT_TRUE(writer->write(i % 3 == 0 ? a : b, time, as_data(data)));
    small.messages.push_back(
        fmt::format("{} std_msgs/String {} {}", i % 3 == 0 ? "/a" : "/b", time.ns, data));
    if (i % 5 == 4) {
      EXPECT_TRUE(writer->flush());
      small.ends.push_back(out->size());
    }
  }
  EXPECT_TRUE(writer->close());
  small.file = *out;
  return small;
}

class EveryPacking : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Mcap, EveryPacking, ::testing::Values(false, true));

TEST_P(EveryPacking, is_read_message_by_message_in_the_order_of_the_file) {
  const SmallMcap small = small_mcap(GetParam());
  const McapReading reading = read_mcap(small.file);
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.messages, small.messages);
  EXPECT_EQ(reading.info.format, "MCAP, profile ros2");
  EXPECT_TRUE(reading.info.is_closed);
  EXPECT_EQ(reading.info.chunks, 4U);
  EXPECT_THAT(reading.info.compression, ::testing::ElementsAre(GetParam() ? "zstd" : "none"));
}

TEST_P(EveryPacking, cut_at_any_byte_gives_the_whole_chunks_before) {
  const SmallMcap small = small_mcap(GetParam());
  std::size_t silent = 0;
  for (std::size_t bytes = 0; bytes < small.file.size(); ++bytes) {
    const McapReading reading = read_mcap(std::string_view(small.file).substr(0, bytes));
    // A chunk is whole some bytes before its end, which its index takes.
    const std::size_t most = static_cast<std::size_t>(
        std::ranges::count_if(small.ends, [&](std::size_t end) { return end <= bytes; }));
    ASSERT_GE(reading.messages.size(), most == 0 ? 0 : 5 * (most - 1)) << "cut at " << bytes;
    ASSERT_LE(reading.messages.size(), 5 * most) << "cut at " << bytes;
    ASSERT_EQ(reading.messages.size() % 5, 0U);
    ASSERT_TRUE(std::ranges::equal(reading.messages,
                                   std::span(small.messages).first(reading.messages.size())));
    silent += reading.error.empty() ? 1 : 0;
    if (!reading.error.empty()) {
      ASSERT_THAT(reading.error, HasSubstr("test.mcap"));
    }
    if (bytes < small.ends.back()) {
      ASSERT_FALSE(reading.info.is_closed) << "cut at " << bytes;
    }
  }
  EXPECT_LT(silent, small.file.size() - small.ends.back() + 20) << "cuts between records, no more";
}

TEST_P(EveryPacking, with_a_flipped_bit_in_its_chunks_is_noticed_or_reads_the_same) {
  const SmallMcap small = small_mcap(GetParam());
  std::size_t changed = 0;
  for (std::size_t bit = 8 * small.ends[0]; bit < 8 * small.ends[1]; ++bit) {
    std::string file = small.file;
    file[bit / 8] = static_cast<char>(file[bit / 8] ^ (1 << (bit % 8)));
    const McapReading reading = read_mcap(file);
    if (reading.error.empty() && reading.messages != small.messages) ++changed;
  }
  // The kind of the record and the checksum itself: a chunk of another kind is passed over.
  EXPECT_LE(changed, 8U);
}

TEST_P(EveryPacking, full_of_noise_never_does_harm) {
  const std::string file = small_mcap(GetParam()).file;
  test::for_each_seed(500, [&](test::Random& random) {
    std::string noisy = file;
    for (int i = 0; i < 20; ++i)
      noisy[random.integer<std::size_t>(8, noisy.size() - 1)] =
          static_cast<char>(random.integer(0, 255));
    (void)read_mcap(noisy);
  });
}

/// A file without chunks, as libmcap writes it where it is asked to.
class PlainMcap {
 public:
  PlainMcap() { file_ = std::string("\x89MCAP0\r\n", 8); }
  PlainMcap& record(char op, const std::string& body) {
    file_ += op + test::Bytes().add(static_cast<std::uint64_t>(body.size())).text() + body;
    ends_.push_back(file_.size());
    return *this;
  }
  PlainMcap& topic(std::uint16_t id, const std::string& name, const std::string& encoding) {
    record(3, test::Bytes().add(id).string("T").string("ros2msg").string("").text());
    return record(
        4,
        test::Bytes().add(id).add(id).string(name).string(encoding).add(std::uint32_t{0}).text());
  }
  PlainMcap& message(std::uint16_t id, std::uint64_t ns, const std::string& data) {
    return record(5, test::Bytes().add(id).add(std::uint32_t{0}).add(ns).add(ns).raw(data).text());
  }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::vector<std::size_t>& ends() const { return ends_; }

 private:
  std::string file_;
  std::vector<std::size_t> ends_;
};

std::string chunk_body(const std::string& compression, const std::string& packed,
                       std::uint64_t unpacked_bytes) {
  return test::Bytes()
      .add(std::uint64_t{0})
      .add(std::uint64_t{0})
      .add(unpacked_bytes)
      .add(std::uint32_t{0})
      .string(compression)
      .add(static_cast<std::uint64_t>(packed.size()))
      .raw(packed)
      .text();
}

TEST(Mcap, without_chunks_is_read_and_cut_at_every_record_boundary_is_no_fault) {
  PlainMcap mcap;
  mcap.record(1, test::Bytes().string("ros1").string("t").text()).topic(1, "/a", "cdr");
  for (int i = 0; i < 5; ++i) mcap.message(1, 10U + i, "data");
  for (const std::size_t end : mcap.ends()) {
    const McapReading reading = read_mcap(mcap.file().substr(0, end));
    EXPECT_EQ(reading.error, "") << end;
    EXPECT_FALSE(reading.info.is_closed);
  }
  EXPECT_EQ(read_mcap(mcap.file()).messages.size(), 5U);
}

TEST(Mcap, without_chunks_is_checked_by_the_checksum_at_the_end_of_its_data) {
  PlainMcap mcap;
  mcap.topic(1, "/a", "cdr").message(1, 1, "data").record(9, "an attachment");
  const std::uint32_t crc = mcap::crc32(std::as_bytes(std::span(mcap.file())));
  const std::string sound = PlainMcap(mcap).record(15, test::Bytes().add(crc).text()).file();
  EXPECT_EQ(read_mcap(sound).error, "");
  for (const std::size_t byte : {sound.find("data"), sound.find("attachment")}) {
    std::string damaged = sound;
    damaged[byte] = 'D';
    EXPECT_THAT(read_mcap(damaged).error, HasSubstr("checksum"));
  }
}

TEST(Mcap, that_ends_in_zeros_as_power_that_fails_leaves_it_is_told_where_they_begin) {
  const std::string sound = PlainMcap().topic(1, "/a", "cdr").message(1, 1, "data").file();
  const McapReading reading = read_mcap(sound + std::string(1U << 20U, '\0'));
  EXPECT_EQ(reading.messages.size(), 1U);
  EXPECT_THAT(reading.error, AllOf(HasSubstr("byte " + std::to_string(sound.size()) + ": nothing"),
                                   HasSubstr("what comes before is sound")));
}

TEST(Mcap, packed_by_lz4_is_read) {
  PlainMcap inner;
  inner.topic(7, "/a", "ros1").message(7, 5, "data");
  const std::string records = inner.file().substr(8);
  std::string packed(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  const McapReading reading =
      read_mcap(PlainMcap().record(6, chunk_body("lz4", packed, records.size())).file());
  EXPECT_EQ(reading.error, "");
  EXPECT_THAT(reading.messages, ::testing::ElementsAre("/a T 5 data"));
}

TEST(Mcap, that_lies_about_lengths_is_refused_at_once) {
  const std::string magic("\x89MCAP0\r\n", 8);
  const auto head = [](char op, std::uint64_t bytes) {
    return op + test::Bytes().add(bytes).text();
  };
  for (const char op : {'\1', '\3', '\4', '\5', '\6', '\7', '\x09', '\x0f'}) {
    for (const std::uint64_t bytes : {std::uint64_t{1}, std::uint64_t{1} << 40U, ~std::uint64_t{0}})
      EXPECT_THAT(read_mcap(magic + head(op, bytes)).error, HasSubstr("ends at byte")) << int(op);
  }
  for (const std::uint64_t size : {std::uint64_t{1} << 29U, ~std::uint64_t{0}, std::uint64_t{5}}) {
    EXPECT_NE(read_mcap(PlainMcap().record(6, chunk_body("zstd", "zz", size)).file()).error, "");
    EXPECT_NE(read_mcap(PlainMcap().record(6, chunk_body("", "zz", size)).file()).error, "");
  }
  EXPECT_THAT(read_mcap(PlainMcap().record(6, chunk_body("zip", "zz", 2)).file()).error,
              HasSubstr("'zip'"));
}

TEST(Mcap, of_another_kind_is_refused_by_name) {
  EXPECT_THAT(read_mcap("").error, HasSubstr("it is no MCAP file"));
  EXPECT_THAT(read_mcap("#ROSBAG V2.0\n").error, HasSubstr("it is no MCAP file"));
  EXPECT_THAT(read_mcap(std::string("\x89MCAP1\r\n", 8)).error, HasSubstr("another version"));
}

TEST(Mcap, whose_messages_or_channels_contradict_each_other_is_refused) {
  EXPECT_THAT(read_mcap(PlainMcap().message(3, 1, "").file()).error, HasSubstr("no known topic"));
  EXPECT_THAT(read_mcap(PlainMcap().topic(1, "/a", "cdr").topic(1, "/b", "cdr").file()).error,
              HasSubstr("share one number"));
  EXPECT_THAT(
      read_mcap(PlainMcap().topic(1, "/a", "cdr").message(1, ~std::uint64_t{0}, "").file()).error,
      HasSubstr("tells no time"));
}

TEST(McapWriter, on_a_full_disk_tells_it_and_leaves_what_was_whole) {
  const auto out = std::make_shared<std::string>();
  auto writer = McapWriter::create(std::make_unique<test::MemorySink>(out, 3000),
                                   {.chunk_bytes = 500, .is_packed = false});
  ASSERT_TRUE(writer);
  const auto topic = writer->add_topic("/a", "T", "ros2msg", "", "cdr");
  const std::string data(100, 'x');
  Status written = Done{};
  for (int i = 0; i < 100 && written; ++i) written = writer->write(topic, Stamp{i}, as_data(data));
  ASSERT_FALSE(written);
  EXPECT_FALSE(writer->close());
  const McapReading reading = read_mcap(*out);
  EXPECT_EQ(reading.error, "");
  EXPECT_GT(reading.messages.size(), 5U);
}

TEST(McapWriter, sends_a_chunk_to_the_disk_once_a_second) {
  const auto out = std::make_shared<std::string>();
  auto writer = McapWriter::create(std::make_unique<test::MemorySink>(out), {});
  ASSERT_TRUE(writer);
  const auto topic = writer->add_topic("/a", "T", "ros2msg", "", "cdr");
  for (int ms = 0; ms <= 3500; ms += 100)
    ASSERT_TRUE(writer->write(topic, Stamp{ms * 1'000'000LL}, as_data("data")));
  EXPECT_GE(read_mcap(*out).messages.size(), 30U) << "of a writer that is killed now";
}

}  // namespace
}  // namespace swiftlet
