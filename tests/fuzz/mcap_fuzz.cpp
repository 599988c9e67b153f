// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are an MCAP file: read to the end, and each message as every type that is looked into.

#include <cstdint>
#include <memory>
#include <vector>

#include "swiftlet/bag/mcap/mcap_reader.hpp"
#include "swiftlet/bag/ros_messages.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const auto bytes = std::as_bytes(std::span(data, size));
  auto reader = McapReader::open(
      std::make_unique<MemoryBytes>(std::vector<std::byte>(bytes.begin(), bytes.end())));
  if (!reader) return 0;
  while (true) {
    const auto message = reader->next();
    if (!message || !*message) return 0;
    (void)ros::parse_frames((*message)->connection->type, (*message)->serialized());
    (void)reader->place_of(**message);
  }
}
