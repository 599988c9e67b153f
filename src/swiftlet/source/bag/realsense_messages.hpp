// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/bag/recording_reader.hpp"

// Recordings of the RealSense SDK. A frame is several messages: its data, then its metadata as
// pairs of words, tied to it by nothing but the same record time. So a frame is complete when the
// next one of its stream begins, or the file ends.

namespace swiftlet {

[[nodiscard]] inline bool is_realsense(const BagMessage& message) {
  return message.connection->topic.starts_with("/device_") ||
         message.connection->topic == "/file_version";
}

}  // namespace swiftlet
