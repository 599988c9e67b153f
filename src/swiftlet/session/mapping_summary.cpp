// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/mapping_summary.hpp"

namespace swiftlet {

std::map<std::string, std::size_t> MappingSummary::dropped() const {
  std::map<std::string, std::size_t> reasons;
  const auto add = [&](std::string_view name, std::size_t count) {
    if (count > 0) reasons[std::string(name)] += count;
  };
  for (std::size_t i = 0; i < kFrameLossNames.size(); ++i) {
    add(kFrameLossNames[i], source_tally.lost[i]);
  }
  for (std::size_t i = 1; i < kFrameVerdictNames.size(); ++i) {
    add(kFrameVerdictNames[i], verdicts[i]);
  }
  return reasons;
}

}  // namespace swiftlet
