// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "swiftlet/bag/mcap/mcap_records.hpp"
#include "swiftlet/base/byte_writer.hpp"

namespace swiftlet::mcap {

/// One record behind the other, each with the length that it turns out to have.
class RecordWriter {
 public:
  explicit RecordWriter(std::vector<std::uint8_t>& out) : out_(out), writer_(out) {}

  template <class Fill>
  void record(Op op, Fill&& fill) {
    writer_.u8(static_cast<std::uint8_t>(op));
    with_length<std::uint64_t>([&] { fill(*this); });
  }
  /// What `fill` writes, behind its length in bytes.
  template <class Length, class Fill>
  void with_length(Fill&& fill) {
    const std::size_t at = out_.size();
    writer_.integer(Length{0});
    fill();
    const auto bytes = static_cast<Length>(out_.size() - at - sizeof(Length));
    for (std::size_t i = 0; i < sizeof(Length); ++i)
      out_[at + i] = static_cast<std::uint8_t>(std::uint64_t{bytes} >> (8 * i));
  }
  void text(std::string_view text) {
    with_length<std::uint32_t>([&] { writer_.text(text); });
  }
  void bytes(std::span<const std::uint8_t> data) { writer_.bytes(data); }
  void u16(std::uint16_t value) { writer_.u16(value); }
  void u32(std::uint32_t value) { writer_.u32(value); }
  void u64(std::uint64_t value) { writer_.u64(value); }

 private:
  std::vector<std::uint8_t>& out_;
  ByteWriter writer_;
};

}  // namespace swiftlet::mcap
