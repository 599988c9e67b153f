// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "swiftlet/bag/bag_message.hpp"
#include "swiftlet/bag/mcap/mcap_records.hpp"

namespace swiftlet::mcap {

/// What an MCAP file has told of its topics so far. What is wrong with a record comes back in
/// words; nullopt if nothing is.
class McapTopics {
 public:
  [[nodiscard]] std::optional<std::string> add_schema(Body body);
  /// Its schema must be known. The same channel may come again, as it does in every chunk.
  [[nodiscard]] std::optional<std::string> add_channel(Body body);

  /// By the number of the channel.
  [[nodiscard]] const std::map<std::uint32_t, BagConnection>& channels() const { return channels_; }

 private:
  std::map<std::uint16_t, std::string> type_by_schema_;
  std::map<std::uint32_t, BagConnection> channels_;
};

}  // namespace swiftlet::mcap
