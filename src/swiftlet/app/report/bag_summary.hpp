// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/bag/recording_reader.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet::app {

/// The messages of one topic of a recording.
struct BagTopicSummary {
  std::string type;
  std::uint64_t messages = 0;
  Stamp first, last;               ///< when they were recorded
  Stamp newest;                    ///< the one before, while reading
  Nanoseconds longest_gap{};       ///< between two that follow each other
  Stamp gap_begin;                 ///< when that began
  std::set<std::string> frames{};  ///< that they tell of, up to kMostFrames
  bool is_read = true;             ///< false: in an encoding that is not

  static constexpr std::size_t kMostFrames = 20;
  /// [s]; 0 for a single message.
  [[nodiscard]] double duration_s() const { return seconds(last - first); }
  /// [Hz]; nullopt with too few to tell.
  [[nodiscard]] std::optional<double> rate_hz() const;
  /// Whether the longest gap is more than the rhythm of the topic.
  [[nodiscard]] bool has_gap() const;
};

/// What a recording holds, found by reading all of it.
struct BagSummary {
  std::string path{};
  std::uint64_t bytes = 0;                          ///< 0 for a folder
  RecordingInfo how{};                              ///< it was written
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
