// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// More connections than there is room for, over real sockets: who may look gets in all the same.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include "station/requests.hpp"
#include "station/served_flight.hpp"

#if SWIFTLET_HAS_VIEW
namespace swiftlet::station {
namespace {

using namespace std::chrono_literals;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Crowd : public ServedFlight {
 protected:
  void start(const std::string& token, std::chrono::milliseconds timeout = 3s) {
    StationOptions options;
    options.access.token = token;
    options.timeout = timeout;
    options.tell = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      told_ += line + "\n";
    };
    serve(options);
  }
  std::string told() {
    const std::lock_guard lock(mutex_);
    return told_;
  }

  ~Crowd() override { station_.reset(); }  // it tells until it ends

  std::mutex mutex_;
  std::string told_;  // guarded by mutex_
};

TEST_F(Crowd, of_silent_strangers_does_not_keep_out_who_has_the_token) {
  start("s3cret-token");
  std::vector<std::unique_ptr<RawSocket>> silent;
  for (int i = 0; i < 200; ++i) {
    silent.push_back(std::make_unique<RawSocket>(port_));
    if (i % 2 == 1) silent.back()->send("GET / HT");
    if (i % 20 != 0) continue;
    EXPECT_THAT(answer_to(get(port_, "", "/?token=s3cret-token")), StartsWith("HTTP/1.1 200"));
    RawSocket socket(port_);
    socket.send(upgrade(port_, "", "/ws?token=s3cret-token"));
    EXPECT_THAT(socket.receive_head(), StartsWith("HTTP/1.1 101"));
  }
  EXPECT_THAT(told(), HasSubstr("more wait and ask nothing than there is room for"));
}

TEST_F(Crowd, of_strangers_is_sent_away_after_a_while_however_they_drip) {
  start("s3cret-token", 100ms);
  const auto begin = std::chrono::steady_clock::now();
  RawSocket silent(port_);
  RawSocket dripping(port_);
  std::string request = get(port_, "X: " + std::string(4000, 'a') + "\r\n", "/?token=s3cret-token");
  pollfd ended{dripping.descriptor(), POLLIN, 0};
  std::size_t sent = 0;
  while (sent < request.size() && poll(&ended, 1, 5) == 0) dripping.send(request.substr(sent++, 1));
  EXPECT_LT(sent, request.size()) << "let it finish, which takes 20 s";
  EXPECT_EQ(silent.receive(), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 4s) << "nobody has sent it away";
}

TEST_F(Crowd, of_connections_that_are_kept_alive_leaves_room_for_more) {
  start("");
  std::vector<std::unique_ptr<RawSocket>> idle;
  for (int i = 0; i < 150; ++i) {
    idle.push_back(std::make_unique<RawSocket>(port_));
    idle.back()->send("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_THAT(idle.back()->receive_head(), StartsWith("HTTP/1.1 200")) << i;
  }
}

TEST_F(Crowd, of_guesses_is_slowed_down_and_told) {
  start("s3cret-token");
  std::string said;
  for (int i = 0; i < 30; ++i)
    said = answer_to(get(port_, "", "/?token=guess-" + std::to_string(i)));
  EXPECT_THAT(said, StartsWith("HTTP/1.1 429"));
  EXPECT_THAT(said, HasSubstr("Retry-After: "));
  EXPECT_THAT(said, HasSubstr("too many wrong tokens"));
  EXPECT_THAT(told(), HasSubstr("turned away 127.0.0.1: the token is wrong"));
}

TEST_F(Crowd, of_pings_ends_the_connection_and_a_few_do_not) {
  flight_.step();
  start("");
  RawSocket modest(port_), flooding(port_);
  for (RawSocket* socket : {&modest, &flooding}) {
    socket->send(upgrade(port_));
    EXPECT_THAT(socket->receive_head(), StartsWith("HTTP/1.1 101"));
  }
  modest.send(RawSocket::frame(9, "hello"));
  int opcode = 0;
  while (opcode != 10 && opcode != -1) opcode = modest.next_message().first;
  EXPECT_EQ(opcode, 10) << "a pong";
  std::string flood;
  for (int i = 0; i < 500; ++i) flood += RawSocket::frame(9, "x");
  flooding.send(flood);
  int pongs = 0;
  for (opcode = 0; opcode != -1; opcode = flooding.next_message().first) pongs += opcode == 10;
  EXPECT_LT(pongs, 100);
}

TEST_F(Crowd, who_calls_the_machine_by_a_name_gets_in_with_the_token_or_is_told_what_to_do) {
  const auto by_name = [&](const std::string& target) {
    return answer_to("GET " + target +
                     " HTTP/1.1\r\nHost: drone.local:18472\r\nConnection: close\r\n\r\n");
  };
  start("abcdefgh12345678");
  EXPECT_THAT(by_name("/?token=abcdefgh12345678"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(by_name("/"), HasSubstr("there is no token"));
  station_.reset();
  start("");
  const std::string said = by_name("/");
  EXPECT_THAT(said, StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(said, HasSubstr("--origin http://drone.local:18472"));
  EXPECT_THAT(told(), HasSubstr("turned away 127.0.0.1: the host name drone.local:18472"));
}

TEST_F(Crowd, a_station_that_listens_everywhere_tells_addresses_that_can_be_opened) {
  StationOptions options;
  options.listen = {"0.0.0.0", 0};
  options.access.token = "s3cret-token";
  const auto station = Station::start(options, flight_.feed);
  ASSERT_TRUE(station) << station.error().text();
  ASSERT_FALSE((*station)->urls().empty());
  for (const std::string& url : (*station)->urls()) {
    EXPECT_THAT(url, Not(AnyOf(HasSubstr("//0.0.0.0"), HasSubstr("[::]"))));
    EXPECT_THAT(url, HasSubstr("?token=s3cret-token"));
  }
}

}  // namespace
}  // namespace swiftlet::station
#endif
