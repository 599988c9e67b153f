// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mavlink/random_message.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/mavlink/wire/packet_parser.hpp"
#include "swiftlet/mavlink/wire/packet_writer.hpp"

namespace swiftlet::mavlink {
namespace {

using test::bytes_of_hex;

/// SHA-256 of "swiftlet".
constexpr std::string_view kKey =
    "1d6b6eea6f387093e032dfadf3562770445637b70419a4d2e5f9f02429bd79f1";
/// HEARTBEAT number 5 of system 42, component 196, signed with it on link 3 by node-mavlink 2.3.0.
constexpr std::string_view kSigned =
    "fd090100052ac400000004030201120800040395f20300e06f9e751974c798d4c276";
constexpr Stamp kSignedAt{1'700'000'000'000'000'000};
constexpr auto kMinute = std::chrono::minutes(1);

SigningKey key() {
  SigningKey key{};
  std::ranges::copy(bytes_of_hex(kKey), key.begin());
  return key;
}

std::size_t passed(PacketParser& parser, std::span<const std::uint8_t> bytes, Stamp now) {
  std::size_t packets = 0;
  parser.feed(bytes, now, [&](const Packet& packet) { packets += packet.is_signed ? 1 : 0; });
  return packets;
}

TEST(Signer, signs_as_another_library_does) {
  const auto frame = bytes_of_hex(kSigned);
  const auto body = std::span(frame).first(frame.size() - wire::kSignatureBytes);
  const auto signature = Signer(key(), 3).sign(body, kSignedAt);
  EXPECT_TRUE(std::ranges::equal(signature, std::span(frame).last(wire::kSignatureBytes)));
}

TEST(Signer, never_signs_twice_at_one_time_even_if_the_clock_is_set_back) {
  Signer signer(key());
  const std::vector<std::uint8_t> frame(12);
  std::uint64_t last = 0;
  for (const Stamp now : {kSignedAt, kSignedAt, kSignedAt - kMinute, Stamp{}}) {
    const Signature signature = signer.sign(frame, now);
    const auto time = layout::load<std::uint64_t>(&signature[1]) & 0xFFFFFFFFFFFFU;
    EXPECT_GT(time, last);
    last = time;
  }
}

TEST(SignatureGuard, admits_what_another_library_has_signed_once) {
  SignatureGuard guard(key());
  PacketParser parser(&guard);
  const auto frame = bytes_of_hex(kSigned);
  EXPECT_EQ(passed(parser, frame, kSignedAt), 1U);
  EXPECT_EQ(passed(parser, frame, kSignedAt), 0U);
  EXPECT_EQ(parser.tally().replayed, 1U);
}

TEST(SignatureGuard, refuses_what_is_not_signed_or_signed_with_another_key) {
  SignatureGuard guard(key());
  PacketParser parser(&guard);
  SigningKey other = key();
  other[31] ^= 1U;
  PacketWriter plain({1, 1}), forger({1, 1}, Signer(other));
  EXPECT_EQ(passed(parser, plain.write(Heartbeat{}, kSignedAt).bytes(), kSignedAt), 0U);
  EXPECT_EQ(passed(parser, forger.write(Heartbeat{}, kSignedAt).bytes(), kSignedAt), 0U);
  EXPECT_EQ(parser.tally().unsigned_packets, 1U);
  EXPECT_EQ(parser.tally().forged, 1U);
  EXPECT_EQ(parser.tally().packets, 0U);
}

TEST(SignatureGuard, lets_no_signed_frame_with_a_changed_bit_pass) {
  const auto frame = bytes_of_hex(kSigned);
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    auto changed = frame;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ (1U << bit % 8));
    SignatureGuard guard(key());
    PacketParser parser(&guard);
    EXPECT_EQ(passed(parser, changed, kSignedAt), 0U) << "bit " << bit;
  }
}

TEST(SignatureGuard, judges_the_time_of_each_sender_by_itself_and_of_new_ones_by_the_newest) {
  SignatureGuard guard(key());
  PacketParser parser(&guard);
  PacketWriter first({1, 1}, Signer(key())), second({1, 2}, Signer(key())),
      third({1, 3}, Signer(key()));
  const auto send = [&](PacketWriter& writer, Stamp signed_at) {
    return passed(parser, writer.write(Heartbeat{}, signed_at).bytes(), kSignedAt);
  };
  EXPECT_EQ(send(first, kSignedAt), 1U);
  EXPECT_EQ(send(second, kSignedAt - kMinute + std::chrono::seconds(1)), 1U);
  EXPECT_EQ(send(third, kSignedAt - kMinute - std::chrono::seconds(1)), 0U);
  // A sender whose clock is ahead makes the others no older than they were.
  EXPECT_EQ(send(first, kSignedAt + 10 * kMinute), 1U);
  EXPECT_EQ(send(second, kSignedAt - kMinute + std::chrono::seconds(2)), 1U);
}

TEST(SignatureGuard, keeps_a_bounded_number_of_senders) {
  SignatureGuard guard(key());
  PacketParser parser(&guard);
  std::size_t admitted = 0;
  for (int component = 0; component < 256; ++component) {
    PacketWriter writer({1, static_cast<std::uint8_t>(component)}, Signer(key()));
    admitted += passed(parser, writer.write(Heartbeat{}, kSignedAt).bytes(), kSignedAt);
  }
  EXPECT_EQ(admitted, SignatureGuard::kMostSenders);
}

TEST(SigningKey, is_read_from_a_file_that_only_its_owner_reads) {
  const test::TempFolder folder;
  const auto path = folder.path() / "key";
  const auto load = [&](std::string_view text, std::filesystem::perms perms) {
    std::ofstream(path) << text;
    std::filesystem::permissions(path, perms);
    return load_signing_key(path);
  };
  using std::filesystem::perms;
  const auto own = perms::owner_read | perms::owner_write;
  EXPECT_EQ(load(std::string(kKey) + "\n", own), key());
  EXPECT_FALSE(load(kKey, own | perms::others_read));
  EXPECT_FALSE(load(kKey.substr(1), own));
  EXPECT_FALSE(load("zz" + std::string(kKey.substr(2)), own));
  EXPECT_FALSE(load("", own));
  EXPECT_EQ(load_signing_key(folder.path() / "none").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace swiftlet::mavlink
