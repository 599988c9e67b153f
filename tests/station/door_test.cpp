// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/door.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "swiftlet/station/http/waiting_room.hpp"
#include "swiftlet/station/places.hpp"

namespace swiftlet::station {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(WaitingRoom, sends_away_who_waits_longest_of_the_address_that_has_most) {
  WaitingRoom room(4);
  std::vector<std::string> gone;
  std::vector<std::shared_ptr<const WaitingRoom::Guest>> tickets;
  const auto enter = [&](const std::string& address, const std::string& name) {
    tickets.push_back(room.enter(address, [&gone, name] { gone.push_back(name); }));
  };
  enter("10.0.0.1", "owner");
  for (const char* name : {"a", "b", "c", "d", "e"}) enter("10.0.0.2", name);
  EXPECT_THAT(gone, ElementsAre("a", "b"));
  EXPECT_EQ(room.waiting(), 4U);
  tickets.clear();  // all have been served, or have left
  EXPECT_EQ(room.waiting(), 0U);
  EXPECT_FALSE(room.send_one_away());
  enter("10.0.0.3", "f");
  EXPECT_TRUE(room.send_one_away());
  EXPECT_THAT(gone, ElementsAre("a", "b", "f"));
}

TEST(Places, are_taken_as_long_as_they_are_held) {
  const Places places(2);
  auto first = places.take();
  const auto second = places.take();
  EXPECT_TRUE(first && second);
  EXPECT_FALSE(places.take());
  first.reset();
  EXPECT_TRUE(places.take());
}

TEST(AttemptLimit, slows_one_address_down_and_no_other) {
  AttemptLimit limit;
  AttemptLimit::Time now{};
  int tries = 0;
  for (int ms = 0; ms < 60'000; ++ms, now += 1ms) {
    if (!limit.may_try("10.0.0.2", now)) continue;
    limit.failed("10.0.0.2", now);
    ++tries;
  }
  EXPECT_NEAR(tries, AttemptLimit::kTriesAtOnce + 60.0 * AttemptLimit::kTriesPerS, 1.0);
  EXPECT_TRUE(limit.may_try("10.0.0.1", now));
}

TEST(AttemptLimit, knows_a_bounded_number_of_addresses) {
  AttemptLimit limit;
  AttemptLimit::Time now{};
  for (int i = 0; i < 5000; ++i, now += 1ms) {
    limit.failed("guesser", now);  // who goes on is not forgotten
    limit.failed(std::to_string(i), now);
  }
  EXPECT_EQ(limit.addresses(), AttemptLimit::kAddresses);
  EXPECT_FALSE(limit.may_try("guesser", now));
}

class Guessing : public ::testing::Test {
 protected:
  Verdict offer(const std::string& token, const std::string& address = "10.0.0.2") {
    const std::string target = "/?token=" + token;
    return door_.judge(address, address, {.host = "127.0.0.1", .target = target}, now_);
  }
  AccessRules rules_{.token = "short-token", .origins = {}};
  std::vector<std::string> told_;
  TellOperator tell_ = [this](const std::string& line) { told_.push_back(line); };
  AttemptLimit::Time now_{};
  Door door_{rules_, tell_, now_};
};

TEST_F(Guessing, at_a_short_token_is_not_told_which_try_was_right) {
  for (int i = 0; i < 10; ++i) EXPECT_EQ(offer("wrong"), Verdict::kWrongToken);
  EXPECT_EQ(offer("wrong"), Verdict::kTooManyTries);
  EXPECT_EQ(offer("short-token"), Verdict::kTooManyTries);
  EXPECT_EQ(offer("short-token", "10.0.0.1"), Verdict::kAllowed) << "from elsewhere";
  EXPECT_EQ(offer(""), Verdict::kWrongToken) << "no token is no try";
  now_ += 3s;
  EXPECT_EQ(offer("short-token"), Verdict::kAllowed);
}

TEST_F(Guessing, never_keeps_out_who_has_a_long_token) {
  rules_.token = random_token();
  for (int i = 0; i < 100; ++i) EXPECT_NE(offer("wrong"), Verdict::kAllowed);
  EXPECT_EQ(offer("wrong"), Verdict::kTooManyTries);
  EXPECT_EQ(offer(rules_.token), Verdict::kAllowed);
}

TEST_F(Guessing, is_told_to_the_operator_without_filling_his_log) {
  for (int i = 0; i < 1000; ++i) offer("wrong");
  ASSERT_EQ(told_.size(), 3U);
  EXPECT_THAT(told_.front(), HasSubstr("turned away 10.0.0.2: the token is wrong"));
  now_ += 10s;
  offer("wrong");
  ASSERT_EQ(told_.size(), 4U);
  EXPECT_THAT(told_.back(), HasSubstr("(997 more since the line before)"));
}

}  // namespace
}  // namespace swiftlet::station
