// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/http_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/station/http/refusal.hpp"

namespace swiftlet::station {
namespace {

/// Styles may be set from scripts, as three.js does on its canvas; markup has none of its own.
HttpAnswer blank(int status, std::string_view host) {
  const std::string policy = fmt::format(
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
      "font-src 'self'; connect-src 'self' ws://{0} wss://{0}; base-uri 'none'; "
      "form-action 'none'; frame-ancestors 'none'",
      host);
  return {status,
          {{"Content-Security-Policy", policy},
           {"X-Content-Type-Options", "nosniff"},
           {"Referrer-Policy", "no-referrer"},
           {"Cross-Origin-Opener-Policy", "same-origin"},
           {"Cross-Origin-Resource-Policy", "same-origin"}},
          {}};
}

/// The map file costs the station work, which no other page may cause.
HttpAnswer map_answer(const HttpQuestion& question) {
  if (question.site == "cross-site" || question.site == "same-site") {
    return plain_answer(403,
                        "a page of another site may not ask for the map; open the address "
                        "of the map itself");
  }
  HttpAnswer found = blank(question.method == "GET" ? 200 : 405, question.credentials.host);
  if (found.status == 405) {
    found.headers.emplace_back("Allow", "GET");
    return found;
  }
  found.is_map = true;
  found.headers.emplace_back("Content-Type", "application/vnd.sqlite3");
  found.headers.emplace_back("Content-Disposition", "attachment; filename=\"map.swl\"");
  found.headers.emplace_back("Cache-Control", "no-store");
  return found;
}

/// A name out of its place would let a header say more than it should.
bool is_printable_host(std::string_view host) {
  return std::ranges::all_of(host, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == ':' || c == '-' || c == '[' || c == ']';
  });
}

}  // namespace

HttpAnswer plain_answer(int status, std::string_view line,
                        std::vector<std::pair<std::string, std::string>> headers) {
  headers.emplace_back("Content-Type", "text/plain; charset=utf-8");
  headers.emplace_back("X-Content-Type-Options", "nosniff");
  headers.emplace_back("Cache-Control", "no-store");
  return {.status = status, .headers = std::move(headers), .text = fmt::format("{}\n", line)};
}

HttpAnswer refusal(Verdict verdict, const Credentials& who) {
  std::vector<std::pair<std::string, std::string>> headers;
  if (verdict == Verdict::kTooManyTries) headers.emplace_back("Retry-After", "30");
  if (verdict == Verdict::kWrongToken) headers.emplace_back("WWW-Authenticate", "Bearer");
  return plain_answer(refusal_status(verdict), refusal_reason(verdict, who), std::move(headers));
}

HttpAnswer busy_answer(std::string_view what) {
  return plain_answer(503, fmt::format("{}; try again in a few seconds", what),
                      {{"Retry-After", "5"}});
}

HttpAnswer answer(const AccessRules& rules, const HttpQuestion& question,
                  std::span<const PageFile> files) {
  const Credentials& who = question.credentials;
  if (const Verdict verdict = judge(rules, who); verdict != Verdict::kAllowed) {
    return refusal(verdict, who);
  }
  if (!is_printable_host(who.host)) {
    return plain_answer(400, "the host name holds characters that no host name has");
  }
  if (question.method != "GET" && question.method != "HEAD") {
    HttpAnswer refused = blank(405, who.host);
    refused.headers.emplace_back("Allow", "GET, HEAD");
    return refused;
  }
  std::string_view path = who.target.substr(0, who.target.find('?'));
  if (path == kMapPath) return map_answer(question);
  if (path == "/") path = "/index.html";
  const auto file = std::ranges::find(files, path, &PageFile::path);
  if (file == files.end()) return blank(404, who.host);

  HttpAnswer found = blank(200, who.host);
  found.headers.emplace_back("Content-Type", std::string(file->mime));
  found.headers.emplace_back("Content-Encoding", "gzip");
  // Names of assets hold a hash of what is in them; the page itself must follow the program.
  found.headers.emplace_back(
      "Cache-Control", path.starts_with("/assets/") ? "max-age=31536000, immutable" : "no-store");
  if (!rules.token.empty() && !query_value(who.target, "token").empty()) {
    // What the page loads next carries no query.
    found.headers.emplace_back("Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict",
                                                         kTokenCookie, rules.token));
  }
  found.body = file->gzip;
  return found;
}

}  // namespace swiftlet::station
