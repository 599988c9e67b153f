// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// Kinds of records of a ROS bag 2.0 (the values are on disk).
enum class BagOp : std::uint8_t {
  kMessage = 0x02,
  kBagHeader = 0x03,
  kIndex = 0x04,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07,
};

/// The fields of a record header: `u32 length, "name=value"` again and again. Only the fields that
/// the reader wants are kept; views point into the header.
struct BagFields {
  std::optional<BagOp> op;
  std::optional<std::uint32_t> conn;
  std::optional<std::uint32_t> size;   ///< of a chunk, unpacked [bytes]
  std::optional<std::uint32_t> count;  ///< of connections in a chunk info
  std::optional<std::uint64_t> index_pos;
  std::optional<std::uint64_t> chunk_pos;
  std::optional<Stamp> time, start_time, end_time;
  std::string_view compression;
  std::string_view topic, type, md5sum;
};

/// Takes a header apart; nullopt if it is malformed or a wanted field has not its size.
[[nodiscard]] std::optional<BagFields> parse_bag_fields(std::span<const std::byte> header);

}  // namespace swiftlet
