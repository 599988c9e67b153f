// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::station {
namespace {

/// It goes to terminals and browsers, and comes from whoever asks.
std::string harmless(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  if (text.empty()) return "(none)";
  std::string out(text.substr(0, kLongest));
  std::ranges::replace_if(
      out,
      [](unsigned char c) {
        return std::isalnum(c) == 0 &&
               std::string_view(".:-_/[]").find(char(c)) == std::string::npos;
      },
      '?');
  return out.size() < text.size() ? out + "..." : out;
}

}  // namespace

std::string refusal_reason(Verdict verdict, const Credentials& who) {
  switch (verdict) {
    case Verdict::kWrongHost:
      return fmt::format(
          "the host name {0} is not known here; use the numeric address, or start the server with "
          "--origin http://{0} or with --token",
          harmless(who.host));
    case Verdict::kWrongOrigin:
      return fmt::format(
          "a page of {0} may not connect; open the address itself, or start the server with "
          "--origin {0}",
          harmless(who.origin));
    case Verdict::kWrongToken:
      return offers_token(who)
                 ? "the token is wrong; open the address that the server printed when it started"
                 : "there is no token; open the whole address that the server printed when it "
                   "started, or send the header 'Authorization: Bearer TOKEN'";
    case Verdict::kTooManyTries:
      return "too many wrong tokens from this address; wait half a minute and take the address "
             "that the server printed (a token of 20 characters or more is never held up)";
    case Verdict::kAllowed:
      break;
  }
  SWIFTLET_REQUIRE(false, "an allowed request has no reason to be refused");
  return {};
}

int refusal_status(Verdict verdict) {
  if (verdict == Verdict::kTooManyTries) return 429;
  return verdict == Verdict::kWrongToken ? 401 : 403;
}

}  // namespace swiftlet::station
