// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace swiftlet {

/// How the fields of a message became bytes.
enum class MessageEncoding : std::uint8_t {
  kRos1,   ///< ROS 1: little-endian, no padding
  kCdr,    ///< ROS 2: CDR behind its header of four bytes, either byte order, plain (not keyed)
  kOther,  ///< JSON, protobuf and others, which are not read
};

/// A message as it was recorded. The bytes belong to somebody else.
struct SerializedMessage {
  MessageEncoding encoding = MessageEncoding::kOther;
  std::span<const std::byte> bytes{};
};

}  // namespace swiftlet
