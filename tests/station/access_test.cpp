// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "swiftlet/station/http/http_answer.hpp"
#include "swiftlet/station/http/listen_address.hpp"
#include "swiftlet/station/state/token_bucket.hpp"
#include "swiftlet/station/station.hpp"

namespace swiftlet::station {
namespace {

using ::testing::_;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

TEST(Access, a_page_from_elsewhere_gets_nothing) {
  const AccessRules rules;
  const auto with_origin = [&](std::string_view origin) {
    return judge(rules, {.host = "127.0.0.1:8080", .origin = origin, .target = "/"});
  };
  EXPECT_EQ(with_origin(""), Verdict::kAllowed) << "no browser";
  EXPECT_EQ(with_origin("http://127.0.0.1:8080"), Verdict::kAllowed);
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:8080", "file://",
                             "http://127.0.0.1:8081", "http://127.0.0.1:8080.evil.example"}) {
    EXPECT_EQ(with_origin(origin), Verdict::kWrongOrigin) << origin;
  }
}

TEST(Access, a_name_that_points_here_gets_nothing) {
  const auto with_host = [](std::string_view host) { return judge({}, {.host = host}); };
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080", "10.0.0.7"}) {
    EXPECT_EQ(with_host(host), Verdict::kAllowed) << host;
  }
  for (const char* host : {"", "evil.example:8080", "127.0.0.1.evil.example", "[", "localhost.evil",
                           "localhost\r\nx:1"}) {
    EXPECT_EQ(with_host(host), Verdict::kWrongHost) << host;
  }
}

TEST(Access, an_origin_that_was_allowed_may_be_host_and_origin) {
  const AccessRules rules{.token = {}, .origins = {"https://map.example.org"}};
  EXPECT_EQ(judge(rules, {.host = "map.example.org", .origin = "https://map.example.org"}),
            Verdict::kAllowed);
  EXPECT_EQ(judge(rules, {.host = "127.0.0.1:80", .origin = "https://map.example.org"}),
            Verdict::kAllowed);
  EXPECT_EQ(judge(rules, {.host = "other.example.org"}), Verdict::kWrongHost);
}

TEST(Access, a_token_may_come_in_three_ways_and_must_be_right) {
  const AccessRules rules{.token = "s3cret-token", .origins = {}};
  Credentials who{.host = "127.0.0.1:8080", .target = "/"};
  EXPECT_EQ(judge(rules, who), Verdict::kWrongToken);
  for (const char* target : {"/?token=s3cret-token", "/a?x=1&token=s3cret-token&y"}) {
    EXPECT_EQ(judge(rules, {.host = who.host, .target = target}), Verdict::kAllowed);
  }
  for (const char* target : {"/?token=", "/?token=s3cret-toke", "/?token=s3cret-tokenx",
                             "/?xtoken=s3cret-token", "/token=s3cret-token"}) {
    EXPECT_EQ(judge(rules, {.host = who.host, .target = target}), Verdict::kWrongToken) << target;
  }
  EXPECT_EQ(judge(rules, {.host = who.host, .cookie = "a=b; swiftlet_token=s3cret-token"}),
            Verdict::kAllowed);
  EXPECT_EQ(judge(rules, {.host = who.host, .cookie = "swiftlet_token=other"}),
            Verdict::kWrongToken);
  EXPECT_EQ(judge(rules, {.host = who.host, .authorization = "Bearer s3cret-token"}),
            Verdict::kAllowed);
}

TEST(Access, tokens_are_made_good_and_different) {
  EXPECT_TRUE(is_good_token(random_token()));
  EXPECT_EQ(random_token().size(), 32U);
  EXPECT_NE(random_token(), random_token());
  for (const char* token : {"", "short", "with space", "semi;colon-", "new\nline-long"}) {
    EXPECT_FALSE(is_good_token(token)) << token;
  }
}

TEST(Access, who_knows_the_token_may_call_the_machine_by_any_name) {
  const AccessRules rules{.token = "s3cret-token", .origins = {}};
  const auto with = [&](std::string_view target, std::string_view origin) {
    return judge(rules, {.host = "drone.local:18472", .origin = origin, .target = target});
  };
  EXPECT_EQ(with("/?token=s3cret-token", ""), Verdict::kAllowed);
  EXPECT_EQ(with("/?token=s3cret-token", "http://drone.local:18472"), Verdict::kAllowed);
  EXPECT_EQ(with("/?token=s3cret-token", "http://evil.example"), Verdict::kWrongOrigin);
  EXPECT_EQ(with("/?token=other-token", ""), Verdict::kWrongToken);
  EXPECT_EQ(with("/", ""), Verdict::kWrongToken);
}

TEST(HttpAnswer, refusals_say_why_and_no_word_of_what_runs_here) {
  const AccessRules rules{.token = "s3cret-token", .origins = {}};
  const auto text_of = [](const AccessRules& asked, const Credentials& who) {
    const HttpAnswer refused = answer(asked, {"GET", who}, {});
    EXPECT_GE(refused.status, 400);
    EXPECT_TRUE(refused.body.empty());
    EXPECT_THAT(refused.text, Not(AnyOf(HasSubstr("wiftlet"), HasSubstr("s3cret"))));
    EXPECT_THAT(refused.headers, Contains(Pair("Content-Type", HasSubstr("text/plain"))));
    EXPECT_THAT(refused.headers, Not(Contains(Pair("Set-Cookie", _))));
    return refused.text;
  };
  EXPECT_THAT(text_of(rules, {.host = "127.0.0.1", .target = "/"}), HasSubstr("no token"));
  EXPECT_THAT(text_of(rules, {.host = "127.0.0.1", .target = "/?token=x"}), HasSubstr("wrong"));
  EXPECT_THAT(text_of({}, {.host = "drone.local:18472", .target = "/"}),
              HasSubstr("--origin http://drone.local:18472"));
  EXPECT_THAT(text_of({}, {.host = "127.0.0.1:1", .origin = "https://a.example", .target = "/"}),
              HasSubstr("--origin https://a.example"));
}

TEST(HttpAnswer, a_refusal_repeats_no_markup_and_no_escapes) {
  const Credentials who{.host = "<b>\x1b[2J\r\nX: y", .target = "/"};
  const std::string text = answer({}, {"GET", who}, {}).text;
  EXPECT_THAT(text, HasSubstr("?b??[2J??X"));
  EXPECT_THAT(text, Not(AnyOf(HasSubstr("<"), HasSubstr("\x1b"), HasSubstr("\r"))));
  const std::string long_name(5000, 'a');
  EXPECT_LT(answer({}, {"GET", {.host = long_name, .target = "/"}}, {}).text.size(), 500U);
}

TEST(HttpAnswer, serves_files_with_a_policy_that_forbids_all_others) {
  const std::uint8_t body[]{1, 2, 3};
  const PageFile files[]{{"/index.html", "text/html; charset=utf-8", body}};
  const HttpAnswer page = answer({}, {"GET", {.host = "127.0.0.1:8080", .target = "/?a=b"}}, files);
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body.size(), 3U);
  EXPECT_THAT(page.headers, Contains(Pair("Content-Security-Policy",
                                          HasSubstr("default-src 'none'; script-src 'self'"))));
  EXPECT_EQ(answer({}, {"POST", {.host = "127.0.0.1", .target = "/"}}, files).status, 405);
  for (const char* target : {"/../etc/passwd", "/index.htm", "//index.html", "", "/%2e%2e/"}) {
    EXPECT_EQ(answer({}, {"GET", {.host = "127.0.0.1", .target = target}}, files).status, 404)
        << target;
  }
}

TEST(ListenAddress, reads_what_people_write) {
  const auto text = [](std::string_view written) { return parse_listen_address(written)->text(); };
  EXPECT_EQ(text("127.0.0.1:9000"), "127.0.0.1:9000");
  EXPECT_EQ(text("localhost:80"), "127.0.0.1:80");
  EXPECT_EQ(text(":9000"), "127.0.0.1:9000");
  EXPECT_EQ(text("0.0.0.0"), "0.0.0.0:8080");
  EXPECT_EQ(text("[::1]:0"), "[::1]:0");
  for (const char* wrong : {"host.example:80", "127.0.0.1:", "127.0.0.1:70000", "1.2.3:80",
                            "127.0.0.1:80x", "127.0.0.1:-1", "::1"}) {
    EXPECT_FALSE(parse_listen_address(wrong)) << wrong;
  }
  EXPECT_TRUE(parse_listen_address("127.9.9.9:1")->is_loopback());
  EXPECT_FALSE(parse_listen_address("0.0.0.0:1")->is_loopback());
}

TEST(Station, is_not_open_to_others_without_a_token) {
  LiveFeed feed;
  StationOptions options;
  options.listen = {"0.0.0.0", 0};
  const auto open = Station::start(options, feed);
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().code, ErrorCode::kUsage);
  EXPECT_THAT(open.error().text(), HasSubstr("--token"));
  options.access.token = "bad token";
  EXPECT_FALSE(Station::start(options, feed));
}

TEST(TokenBucket, lets_the_rate_through_on_average_and_not_more) {
  using namespace std::chrono_literals;
  TokenBucket::Clock::time_point now{};
  TokenBucket bucket(100.0, 10.0, now);
  double through = 0.0;
  for (int ms = 0; ms < 10'000; ++ms) {
    now += 1ms;
    if (!bucket.is_open(now)) continue;
    bucket.spend(7.0);
    through += 7.0;
  }
  EXPECT_NEAR(through, 1000.0, 10.0 + 7.0);  // burst and one debt
}

}  // namespace
}  // namespace swiftlet::station
