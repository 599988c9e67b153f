// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/page/client_message.hpp"

#include <string>

namespace swiftlet::station {
namespace {

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{bytes[offset + i]} << (8 * i);
  return word;
}

tl::unexpected<Error> no_message(const std::string& what) {
  return fail(ErrorCode::kCorruptInput, "client message", what);
}

enum class Kind : std::uint8_t { kResend = 1, kSendAll = 2, kSetPace = 3, kSetRate = 4 };

}  // namespace

Expected<ClientMessage> parse_client_message(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4) return no_message("shorter than 4 bytes");
  if (bytes[2] != 0 || bytes[3] != 0) return no_message("bytes 2 and 3 are not zero");
  const auto is_long = [&](std::size_t size) { return bytes.size() == size; };
  switch (static_cast<Kind>(bytes[0])) {
    case Kind::kResend:
      if (bytes[1] != 0 || !is_long(12)) return no_message("a resend has 12 bytes");
      return Resend{word_at(bytes, 4), word_at(bytes, 8)};
    case Kind::kSendAll:
      if (bytes[1] != 0 || !is_long(4)) return no_message("a send-all has 4 bytes");
      return SendAll{};
    case Kind::kSetPace:
      if (bytes[1] > static_cast<std::uint8_t>(Pace::kStep) || !is_long(4)) {
        return no_message("a pace is 0, 1 or 2, in 4 bytes");
      }
      return SetPace{static_cast<Pace>(bytes[1])};
    case Kind::kSetRate:
      if (bytes[1] != 0 || !is_long(8)) return no_message("a rate has 8 bytes");
      return SetRate{word_at(bytes, 4)};
  }
  return no_message("of unknown type " + std::to_string(bytes[0]));
}

}  // namespace swiftlet::station
