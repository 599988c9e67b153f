// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet::app {

/// The messages of one topic of a bag.
struct BagTopicSummary {
  std::string type;
  std::uint64_t messages = 0;
  Stamp first, last;  ///< when they were recorded
};

/// What a ROS bag holds, found by reading all of it.
struct BagSummary {
  std::string path{};
  std::uint64_t bytes = 0;
  std::uint64_t chunks = 0;
  std::string compression{};                        ///< "none", "lz4", "bz2" or several of them
  std::map<std::string, BagTopicSummary> topics{};  ///< by name
  std::vector<std::pair<std::string, std::string>>
      device{};                        ///< what the RealSense SDK tells of it
  std::vector<std::string> choices{};  ///< what `swiftlet map` would take of it, in words
  std::optional<Error> fault{};        ///< where it is damaged; the rest holds what came before
};

/// Errors: those of opening it.
[[nodiscard]] Expected<BagSummary> summarize_bag(const std::string& path);
[[nodiscard]] std::string bag_text(const BagSummary& bag);
[[nodiscard]] std::string bag_json(const BagSummary& bag);

}  // namespace swiftlet::app
