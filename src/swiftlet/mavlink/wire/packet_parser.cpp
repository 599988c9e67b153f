// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/wire/packet_parser.hpp"

#include <algorithm>

#include "swiftlet/mavlink/wire/crc.hpp"
#include "swiftlet/mavlink/wire/messages.hpp"

namespace swiftlet::mavlink {
namespace {

std::uint32_t message_id(std::span<const std::uint8_t> frame) {
  return frame[wire::kId] | static_cast<std::uint32_t>(frame[wire::kId + 1]) << 8U |
         static_cast<std::uint32_t>(frame[wire::kId + 2]) << 16U;
}

bool is_sound(std::span<const std::uint8_t> frame, std::uint8_t crc_extra) {
  const std::size_t end = wire::kHeaderBytes + frame[wire::kLength];
  const std::uint16_t crc = crc_with(crc_with(kCrcStart, frame.subspan(1, end - 1)), crc_extra);
  return layout::load<std::uint16_t>(&frame[end]) == crc;
}

}  // namespace

std::size_t PacketParser::take(std::span<const std::uint8_t> bytes) {
  std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_),
            bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin());
  end_ -= begin_;
  begin_ = 0;
  // next() leaves less than a frame behind, so there is room.
  const std::size_t count = std::min(bytes.size(), bytes_.size() - end_);
  std::ranges::copy(bytes.first(count), bytes_.begin() + static_cast<std::ptrdiff_t>(end_));
  end_ += count;
  return count;
}

void PacketParser::skip_to_start() {
  const auto bytes = waiting();
  const auto junk =
      static_cast<std::size_t>(std::ranges::find(bytes, wire::kStart) - bytes.begin());
  if (junk > 0) is_in_step_ = false;
  tally_.skipped_bytes += junk;
  begin_ += junk;
}

std::optional<Packet> PacketParser::next(Stamp now) {
  while (true) {
    skip_to_start();
    const auto bytes = waiting();
    if (bytes.size() <= wire::kMustUnderstand) return std::nullopt;
    const std::uint8_t flags = bytes[wire::kMustUnderstand];
    if ((flags & ~wire::kIsSigned) != 0) {
      ++tally_.unknown_flags;
      skip_start();
      continue;
    }
    const std::size_t size = wire::kHeaderBytes + bytes[wire::kLength] + wire::kCrcBytes +
                             (flags != 0 ? wire::kSignatureBytes : 0);
    if (bytes.size() < size) return std::nullopt;
    const auto frame = bytes.first(size);
    const MessageKind* const kind = find_message(message_id(frame));
    if (kind != nullptr && !is_sound(frame, kind->crc_extra)) {
      ++tally_.bad_checksums;
      skip_start();
      continue;
    }
    if (kind == nullptr && !is_in_step_) {
      skip_start();
      continue;
    }
    begin_ += size;
    is_in_step_ = true;
    if (kind == nullptr) {
      ++tally_.unknown_messages;
    } else if (auto packet = judge(frame, now)) {
      return packet;
    }
  }
}

std::optional<Packet> PacketParser::judge(std::span<const std::uint8_t> frame, Stamp now) {
  if (guard_ != nullptr && !is_admitted(frame, now)) return std::nullopt;
  ++tally_.packets;
  Packet packet;
  packet.from = {frame[wire::kSystem], frame[wire::kComponent]};
  packet.sequence = frame[wire::kSequence];
  packet.id = message_id(frame);
  packet.is_signed = guard_ != nullptr;
  std::ranges::copy(frame.subspan(wire::kHeaderBytes, frame[wire::kLength]),
                    packet.payload.begin());
  return packet;
}

bool PacketParser::is_admitted(std::span<const std::uint8_t> frame, Stamp now) {
  const auto fault = guard_->judge(frame, now);
  if (!fault) return true;
  switch (*fault) {
    case SignatureFault::kMissing:
      ++tally_.unsigned_packets;
      break;
    case SignatureFault::kForged:
      ++tally_.forged;
      break;
    case SignatureFault::kReplayed:
      ++tally_.replayed;
      break;
  }
  return false;
}

}  // namespace swiftlet::mavlink
