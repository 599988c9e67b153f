// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/flight_news.hpp"

#include <utility>

namespace swiftlet::mavlink {

void FlightNews::map_begun(MapReader reader) {
  std::optional<MapReader> before;  // let go of after the lock
  const std::scoped_lock lock(mutex_);
  before = std::exchange(begun_, std::move(reader));
}

std::optional<MapReader> FlightNews::take_map() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(begun_, std::nullopt);
}

void FlightNews::tell_pilot(Urgency urgency, std::string_view text) {
  const std::scoped_lock lock(mutex_);
  if (sentences_.size() == kMostSentences) sentences_.erase(sentences_.begin());
  sentences_.push_back({urgency, std::string(text)});
}

std::vector<FlightNews::Sentence> FlightNews::take_sentences() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(sentences_, {});
}

}  // namespace swiftlet::mavlink
