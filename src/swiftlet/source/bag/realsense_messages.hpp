// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <utility>

#include "swiftlet/bag/recording_reader.hpp"

// Recordings of the RealSense SDK. A frame is several messages: its data, then its metadata as
// pairs of words, tied to it by nothing but the same record time. So a frame is complete when the
// next one of its stream begins, or the file ends.

namespace swiftlet {

/// The next message. A fault of the file waits in `fault` while a frame from before it is pending:
/// the stream seems to end, gives that frame, and then tells the fault.
[[nodiscard]] inline Expected<std::optional<BagMessage>> read_after(RecordingReader& reader,
                                                                    std::optional<Error>& fault,
                                                                    bool is_pending) {
  if (fault && !is_pending) return tl::make_unexpected(*std::exchange(fault, std::nullopt));
  auto message = reader.next();
  if (message || !is_pending) return message;
  fault = std::move(message.error());
  return std::nullopt;
}

[[nodiscard]] inline bool is_realsense(const BagMessage& message) {
  return message.connection->topic.starts_with("/device_") ||
         message.connection->topic == "/file_version";
}

}  // namespace swiftlet
