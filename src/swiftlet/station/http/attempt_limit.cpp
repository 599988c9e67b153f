// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/attempt_limit.hpp"

#include <algorithm>

namespace swiftlet::station {

bool AttemptLimit::may_try(const std::string& address, Time now) {
  const auto found = known_.find(address);
  return found == known_.end() || found->second.tries.is_open(now);
}

void AttemptLimit::failed(const std::string& address, Time now) {
  if (!known_.contains(address) && known_.size() >= kAddresses) {
    known_.erase(
        std::ranges::min_element(known_, {}, [](const auto& entry) { return entry.second.last; }));
  }
  auto& entry = known_.try_emplace(address, Entry{TokenBucket(kTriesPerS, kTriesAtOnce, now), now})
                    .first->second;
  entry.last = now;
  entry.tries.spend(1.0);
}

}  // namespace swiftlet::station
