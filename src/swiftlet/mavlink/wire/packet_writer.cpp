// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/wire/packet_writer.hpp"

#include <algorithm>

#include "swiftlet/mavlink/wire/crc.hpp"

namespace swiftlet::mavlink {

WireFrame PacketWriter::frame(std::uint32_t id, std::uint8_t crc_extra,
                              std::span<const std::uint8_t> payload, Stamp now) {
  WireFrame frame;
  auto& bytes = frame.bytes_;
  bytes[0] = wire::kStart;
  bytes[wire::kLength] = static_cast<std::uint8_t>(payload.size());
  bytes[wire::kMustUnderstand] = signer_ ? wire::kIsSigned : std::uint8_t{0};
  bytes[wire::kSequence] = sequence_++;
  bytes[wire::kSystem] = from_.system;
  bytes[wire::kComponent] = from_.component;
  for (std::size_t i = 0; i < 3; ++i)
    bytes[wire::kId + i] = static_cast<std::uint8_t>(id >> (8 * i));
  std::ranges::copy(payload, bytes.begin() + wire::kHeaderBytes);
  const std::size_t end = wire::kHeaderBytes + payload.size();
  const std::uint16_t crc =
      crc_with(crc_with(kCrcStart, std::span(bytes).subspan(1, end - 1)), crc_extra);
  layout::store(crc, &bytes[end]);
  frame.size_ = end + wire::kCrcBytes;
  if (signer_) {
    const Signature signature = signer_->sign(frame.bytes(), now);
    std::ranges::copy(signature, bytes.begin() + static_cast<std::ptrdiff_t>(frame.size_));
    frame.size_ += signature.size();
  }
  return frame;
}

}  // namespace swiftlet::mavlink
