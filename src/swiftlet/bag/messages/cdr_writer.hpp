// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "swiftlet/base/byte_writer.hpp"

namespace swiftlet {

/// Writes a ROS 2 message as its middleware does: CDR (XCDR1), little endian, each number aligned
/// to its size from behind the header of four bytes.
class CdrWriter {
 public:
  explicit CdrWriter(std::vector<std::uint8_t>& out)
      : out_(out), writer_(out), start_(out.size() + 4) {
    writer_.u32(0x0100);  // 00 01: little endian; 00 00: no options
  }

  void u8(std::uint8_t value) { writer_.u8(value); }
  void u32(std::uint32_t value) {
    align(4);
    writer_.u32(value);
  }
  void i32(std::int32_t value) { u32(static_cast<std::uint32_t>(value)); }
  void f64(double value) {
    align(8);
    writer_.f64(value);
  }
  void text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    writer_.text(value);
    writer_.u8(0);
  }
  void bytes(std::span<const std::uint8_t> data) {
    u32(static_cast<std::uint32_t>(data.size()));
    writer_.bytes(data);
  }
  void count(std::size_t elements) { u32(static_cast<std::uint32_t>(elements)); }

 private:
  void align(std::size_t size) {
    while ((out_.size() - start_) % size != 0) writer_.u8(0);
  }

  std::vector<std::uint8_t>& out_;
  ByteWriter writer_;
  std::size_t start_;
};

}  // namespace swiftlet
