// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/bag/byte_sink.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// Writes an MCAP file as its readers want it: chunks packed by zstd with checksums and an index of
/// their messages, the definitions of the types inside, and at the end an index of all and
/// statistics, so that a viewer can jump to any time.
///
/// A chunk goes to the disk as soon as it is full or spans a second: of a writer that is killed,
/// readers get all but the last second.
/// Memory: one chunk and one message, and some hundred bytes for each chunk that is written.
/// Thread safety: none, one owner. Source: mcap.dev/spec.
class McapWriter {
 public:
  struct Options {
    std::string profile = "ros2";
    std::size_t chunk_bytes = 1U << 20U;
    bool is_packed = true;  ///< chunks by zstd
  };
  using Metadata = std::map<std::string, std::string>;

  /// Begins the file. Errors: kIo.
  [[nodiscard]] static Expected<McapWriter> create(ByteSinkPtr sink, Options options);
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) = delete;
  /// What is not closed ends as a killed writer's file does.
  ~McapWriter();

  /// A topic and the definition of its messages, as in ("/tf", "tf2_msgs/msg/TFMessage", "ros2msg",
  /// text, "cdr"). Returns its number. REQUIRES: fewer than 65535 topics.
  std::uint16_t add_topic(std::string_view topic, std::string_view type,
                          std::string_view schema_encoding, std::string_view definition,
                          std::string_view message_encoding);

  /// Errors: kIo, after which nothing more is written. REQUIRES: a number of add_topic(); time >=
  /// 0.
  [[nodiscard]] Status write(std::uint16_t topic, Stamp time, std::span<const std::uint8_t> data);
  /// Words about the whole file. Errors: kIo.
  [[nodiscard]] Status write_metadata(std::string_view name, const Metadata& words);

  /// Ends the chunk that is being filled. Errors: kIo.
  [[nodiscard]] Status flush();
  /// Writes the index; the file is whole. Errors: kIo.
  [[nodiscard]] Status close();

  [[nodiscard]] std::uint64_t messages() const;

 private:
  class State;
  explicit McapWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
