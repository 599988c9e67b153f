// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <random>

namespace swiftlet::station {
namespace {

/// "127.0.0.1:8080" without its port, "[::1]:8080" without port and brackets.
std::string_view host_name(std::string_view host) {
  if (host.starts_with('[')) {
    const auto end = host.find(']');
    return end == std::string_view::npos ? std::string_view{} : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

bool is_numeric_or_local(std::string_view name) {
  if (name == "localhost") return true;
  const bool is_v6 = name.find(':') != std::string_view::npos;
  const bool has_only_digits = std::ranges::all_of(name, [&](unsigned char c) {
    return is_v6 ? std::isxdigit(c) != 0 || c == ':' : std::isdigit(c) != 0 || c == '.';
  });
  return !name.empty() && has_only_digits;
}

std::string_view without_scheme(std::string_view origin) {
  const auto scheme = origin.find("://");
  return scheme == std::string_view::npos ? origin : origin.substr(scheme + 3);
}

std::string_view cookie_value(std::string_view cookies, std::string_view key) {
  while (!cookies.empty()) {
    const auto end = std::min(cookies.find(';'), cookies.size());
    std::string_view pair = cookies.substr(0, end);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    while (pair.starts_with(' ')) pair.remove_prefix(1);
    if (pair.starts_with(key) && pair.substr(key.size()).starts_with('=')) {
      return pair.substr(key.size() + 1);
    }
  }
  return {};
}

/// The three places that a token may come in.
std::array<std::string_view, 3> tokens_of(const Credentials& credentials) {
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view bearer = credentials.authorization.starts_with(kBearer)
                                      ? credentials.authorization.substr(kBearer.size())
                                      : std::string_view{};
  return {query_value(credentials.target, "token"), cookie_value(credentials.cookie, kTokenCookie),
          bearer};
}

}  // namespace

bool is_same_secret(std::string_view a, std::string_view b) {
  unsigned differences = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    differences |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(other);
  }
  return differences == 0;
}

std::string_view query_value(std::string_view target, std::string_view key) {
  const auto question = target.find('?');
  if (question == std::string_view::npos) return {};
  std::string_view query = target.substr(question + 1);
  while (!query.empty()) {
    const auto end = std::min(query.find('&'), query.size());
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    if (pair.starts_with(key) && pair.substr(key.size()).starts_with('=')) {
      return pair.substr(key.size() + 1);
    }
  }
  return {};
}

bool offers_token(const Credentials& credentials) {
  return std::ranges::any_of(tokens_of(credentials), [](auto token) { return !token.empty(); });
}

Verdict judge(const AccessRules& rules, const Credentials& credentials) {
  const auto names_host = [&](const std::string& origin) {
    return without_scheme(origin) == credentials.host;
  };
  const bool knows_host = is_numeric_or_local(host_name(credentials.host)) ||
                          std::ranges::any_of(rules.origins, names_host);
  // A page that was made to point here does not know the token, whatever it calls this machine.
  if (!knows_host && rules.token.empty()) return Verdict::kWrongHost;
  if (!credentials.origin.empty()) {
    const bool is_own = credentials.origin == fmt::format("http://{}", credentials.host);
    const bool is_allowed =
        std::ranges::find(rules.origins, credentials.origin) != rules.origins.end();
    if (!is_own && !is_allowed) return Verdict::kWrongOrigin;
  }
  if (rules.token.empty()) return Verdict::kAllowed;
  for (const std::string_view offered : tokens_of(credentials)) {
    if (is_same_secret(rules.token, offered)) return Verdict::kAllowed;
  }
  return Verdict::kWrongToken;
}

std::string random_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

bool is_good_token(std::string_view token) {
  constexpr std::size_t kMinLength = 8;
  constexpr std::size_t kMaxLength = 128;
  return token.size() >= kMinLength && token.size() <= kMaxLength &&
         std::ranges::all_of(
             token, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
}

}  // namespace swiftlet::station
