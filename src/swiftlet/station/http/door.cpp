// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/door.hpp"

#include "swiftlet/station/http/refusal.hpp"

namespace swiftlet::station {
namespace {

/// Tokens of this length are not found by guessing, however often somebody tries.
constexpr std::size_t kBeyondGuessing = 20;

}  // namespace

Verdict Door::judge(const std::string& guesser, const std::string& address, const Credentials& who,
                    Time now) {
  const Verdict verdict = limited(guesser, who, now);
  if (verdict != Verdict::kAllowed) note(address, refusal_reason(verdict, who), now);
  return verdict;
}

/// Where somebody guesses, a right answer to a short token must look like a wrong one, or the limit
/// would limit nothing. A long token always opens: nobody can keep its owner out by guessing.
Verdict Door::limited(const std::string& guesser, const Credentials& who, Time now) {
  const Verdict verdict = station::judge(rules_, who);
  const bool is_guess = verdict == Verdict::kWrongToken && offers_token(who);
  const bool is_right = verdict == Verdict::kAllowed && !rules_.token.empty();
  if (!is_guess && !is_right) return verdict;
  if (is_right && rules_.token.size() >= kBeyondGuessing) return verdict;
  if (!attempts_.may_try(guesser, now)) return Verdict::kTooManyTries;
  if (is_guess) attempts_.failed(guesser, now);
  return verdict;
}

void Door::note(const std::string& address, const std::string& why, Time now) {
  if (!tell_) return;
  if (const auto line = log_.note(address, why, now)) tell_(*line);
}

}  // namespace swiftlet::station
