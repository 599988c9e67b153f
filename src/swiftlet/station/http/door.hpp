// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <string>

#include "swiftlet/station/http/access.hpp"
#include "swiftlet/station/http/attempt_limit.hpp"
#include "swiftlet/station/http/refusal_log.hpp"

namespace swiftlet::station {

/// Takes a line for people who run the station; called from its thread.
using TellOperator = std::function<void(const std::string&)>;

/// Who gets in: the rules, how often an address may guess at the token, and a line for the operator
/// about whoever does not.
/// Thread safety: the station's thread alone.
class Door {
 public:
  using Time = AttemptLimit::Time;

  /// Both must outlive it. `tell` may be empty.
  Door(const AccessRules& rules, const TellOperator& tell, Time now)
      : rules_(rules), tell_(tell), log_(now) {}

  /// `guesser` is what tries are counted by, `address` what the operator is told.
  [[nodiscard]] Verdict judge(const std::string& guesser, const std::string& address,
                              const Credentials& who, Time now);
  /// Says that somebody was turned away, unless that was said often enough of late.
  void note(const std::string& address, const std::string& why, Time now);

 private:
  Verdict limited(const std::string& guesser, const Credentials& who, Time now);

  const AccessRules& rules_;
  const TellOperator& tell_;
  AttemptLimit attempts_;
  RefusalLog log_;
};

}  // namespace swiftlet::station
