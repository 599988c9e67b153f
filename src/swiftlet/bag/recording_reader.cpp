// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/recording_reader.hpp"

#include <fmt/format.h>

#include <utility>

#include "swiftlet/bag/chunk_codec.hpp"

namespace swiftlet {

std::string RecordingReader::place_of(const BagMessage& message) const {
  return fmt::format("{}: byte {} ({})", name(), message.offset, message.connection->topic);
}

Expected<std::optional<BagMessage>> RecordingReader::next() {
  auto message = read_next();
  if (!message || !*message) return message;
  // rosbag2 can pack each message; one of CDR begins with a zero and never with zstd's mark.
  if ((*message)->connection->encoding == MessageEncoding::kCdr && is_zstd((*message)->data)) {
    auto fault = unpack_zstd_frame((*message)->data, unpacked_);
    packed_bytes_ += (*message)->data.size();
    unpacked_bytes_ += unpacked_.size();
    if (!fault && !is_growth_plausible(packed_bytes_, unpacked_bytes_))
      fault = "its messages unpack to more than images do";
    if (fault) {
      end();
      return fail(ErrorCode::kCorruptInput, place_of(**message),
                  "the message cannot be unpacked: " + *fault,
                  "the recording is damaged there; copy it again");
    }
    (*message)->data = unpacked_;
  }
  bytes_read_ += (*message)->data.size();
  return message;
}

}  // namespace swiftlet
