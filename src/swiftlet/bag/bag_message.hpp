// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "swiftlet/bag/messages/serialized_message.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// The most that the name of a topic or a type may take [bytes].
inline constexpr std::size_t kMostNameBytes = 4096;

/// A topic as one publisher wrote it.
struct BagConnection {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;   ///< as in "sensor_msgs/Image", in recordings of ROS 2, too
  std::string md5{};  ///< of the type's definition, in ROS 1
  MessageEncoding encoding = MessageEncoding::kRos1;
};

/// A serialised message; its bytes stay until the next call of RecordingReader::next().
struct BagMessage {
  const BagConnection* connection;
  Stamp record_time;  ///< when it was written; RealSense recordings count from 0
  std::span<const std::byte> data;
  std::uint64_t offset;  ///< where it is in the file, see RecordingReader::place_of()

  [[nodiscard]] SerializedMessage serialized() const { return {connection->encoding, data}; }
};

}  // namespace swiftlet
