// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes come over a link: as addresses of links, as frames, and, since random bytes hardly ever
// have a sound checksum, as payloads of every message in frames of ours, some of them signed.

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "swiftlet/mavlink/links/link_address.hpp"
#include "swiftlet/mavlink/wire/packet_parser.hpp"
#include "swiftlet/mavlink/wire/packet_writer.hpp"

namespace {

using namespace swiftlet;
using namespace swiftlet::mavlink;

constexpr SigningKey kKey{1, 2, 3};

/// The payload of one message survives unpacking, framing, parsing and packing.
template <class Message>
void round_trip(const Payload& payload, bool is_signed) {
  const auto message = unpack<Message>(payload);
  SignatureGuard guard(kKey);
  PacketParser parser(is_signed ? &guard : nullptr);
  PacketWriter writer({1, 2}, is_signed ? std::optional(Signer(kKey)) : std::nullopt);
  std::size_t packets = 0;
  parser.feed(writer.write(message, {}).bytes(), {}, [&](const Packet& packet) {
    ++packets;
    Payload again{}, sent{};
    if (pack(*packet.as<Message>(), again) != pack(message, sent) || again != sent) std::abort();
  });
  if (packets != 1) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  (void)parse_link_address({reinterpret_cast<const char*>(data), size});
  SignatureGuard guard(kKey);
  PacketParser open, guarded(&guard);
  const std::size_t cut = size == 0 ? 0 : data[0] % size;
  for (PacketParser* parser : {&open, &guarded}) {
    std::size_t packets = 0;
    const auto count = [&](const Packet&) { ++packets; };
    parser->feed(bytes.first(cut), {}, count);
    parser->feed(bytes.subspan(cut), {}, count);
    if (packets != parser->tally().packets) std::abort();
  }
  Payload payload{};
  std::copy_n(data, std::min(size, payload.size()), payload.begin());
  for_each_message(
      [&]<class Message>(const Message&) { round_trip<Message>(payload, size % 2 == 1); });
  return 0;
}
