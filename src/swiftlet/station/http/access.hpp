// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::station {

/// Who may look. A page from elsewhere, open in the same browser, must not: a browser sends its
/// requests to 127.0.0.1, too.
struct AccessRules {
  std::string token;                 ///< empty: none is asked for
  std::vector<std::string> origins;  ///< besides our own page, as in "https://map.example.org"
};

/// What a request says of itself; empty where it says nothing.
struct Credentials {
  std::string_view host{};           ///< header Host
  std::string_view origin{};         ///< header Origin
  std::string_view target{};         ///< path and query
  std::string_view cookie{};         ///< header Cookie
  std::string_view authorization{};  ///< header Authorization
};

enum class Verdict : unsigned char {
  kAllowed,
  kWrongHost,
  kWrongOrigin,
  kWrongToken,
  kTooManyTries,  ///< never from judge(): see Door
};

/// Host must be numeric, localhost or that of an allowed origin, which no name that was made to
/// point here is (DNS rebinding); whoever knows the token may use any name. An Origin must be our
/// own page's or allowed. The token, if there is one, must come as `?token=`, as our cookie or as
/// `Authorization: Bearer`.
[[nodiscard]] Verdict judge(const AccessRules& rules, const Credentials& credentials);

/// Whether it comes with any token, right or wrong.
[[nodiscard]] bool offers_token(const Credentials& credentials);

/// Takes the same time wherever the two differ.
[[nodiscard]] bool is_same_secret(std::string_view a, std::string_view b);

/// The value of a key in the query of a target, as it stands there; empty if it is absent.
[[nodiscard]] std::string_view query_value(std::string_view target, std::string_view key);

/// Letters, digits, - and _ only, so that it needs no escaping: 128 random bits.
[[nodiscard]] std::string random_token();
/// Whether a token of the user's own is at least 8 of these characters.
[[nodiscard]] bool is_good_token(std::string_view token);

inline constexpr std::string_view kTokenCookie = "swiftlet_token";

}  // namespace swiftlet::station
