// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The server with real sockets: clients that keep to the rules, and clients that do not.

#include "swiftlet/station/station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "station/requests.hpp"
#include "station/served_flight.hpp"
#include "station/wire_reader.hpp"
#include "swiftlet/station/page/client_message.hpp"

#if SWIFTLET_HAS_VIEW
namespace swiftlet::station {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class RunningStation : public ServedFlight {
 protected:
  void start(const std::string& token = "", std::size_t max_clients = 20) {
    StationOptions options;
    options.access.token = token;
    options.max_clients = max_clients;
    serve(options);
  }
  std::string random_bytes() {
    std::string bytes(random_.integer<std::size_t>(1, 400), '\0');
    for (char& c : bytes) c = static_cast<char>(random_.integer(0, 255));
    return bytes;
  }
  /// Reads until the client has been told that it holds the whole map, and does.
  static void expect_complete(RawSocket& socket, WireReader& client) {
    client.checksum.reset();
    while (!client.checksum) {
      const auto [opcode, message] = socket.next_message();
      ASSERT_NE(opcode, -1) << "the server has closed the connection";
      if (opcode == 2) client.read(message);
    }
    EXPECT_EQ(client.digest(small_info().header.scale.thresholds), *client.checksum);
  }
};

TEST_F(RunningStation, serves_the_page_and_the_map) {
  flight_.step();
  start();
  EXPECT_THAT(answer_to(get(port_)), StartsWith("HTTP/1.1 200 OK"));
  EXPECT_THAT(answer_to(get(port_, "", "/nothing")), StartsWith("HTTP/1.1 404"));
  RawSocket socket(port_);
  socket.send(upgrade(port_));
  EXPECT_THAT(socket.receive_head(), HasSubstr("Sec-WebSocket-Protocol: swiftlet.v1"));
  WireReader client;
  expect_complete(socket, client);
  EXPECT_EQ(client.digest(small_info().header.scale.thresholds), flight_.truth());
  for (int i = 0; i < 30; ++i) flight_.step();
  while (client.digest(small_info().header.scale.thresholds) != flight_.truth()) {
    expect_complete(socket, client);
    if (HasFailure()) return;
  }
}

TEST_F(RunningStation, a_wrong_token_or_origin_gets_nothing) {
  start("s3cret-token");
  const std::string evil = "Origin: http://evil.example\r\n";
  for (const std::string& request :
       {get(port_), get(port_, "", "/?token=s3cret-tokex"), upgrade(port_),
        upgrade(port_, "", "/ws?token=wrong-token"), get(port_, evil, "/?token=s3cret-token"),
        upgrade(port_, evil, "/ws?token=s3cret-token")}) {
    const std::string said = answer_to(request);
    EXPECT_THAT(said, testing::ContainsRegex("^HTTP/1.1 40[13] ")) << request;
    EXPECT_THAT(said, HasSubstr("Content-Type: text/plain")) << request;
    EXPECT_THAT(said, Not(HasSubstr("Set-Cookie"))) << request;
  }
  EXPECT_THAT(answer_to(get(port_, "", "/?token=s3cret-token")), HasSubstr("Set-Cookie: swiftlet"));
  RawSocket socket(port_);
  socket.send(upgrade(port_, "Cookie: swiftlet_token=s3cret-token\r\n"));
  EXPECT_THAT(socket.receive_head(), StartsWith("HTTP/1.1 101"));
}

TEST_F(RunningStation, speaks_only_languages_that_it_knows) {
  start();
  EXPECT_THAT(answer_to(upgrade(port_, "", "/ws", "other.v9")), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer_to(upgrade(port_, "", "/ws", "")), StartsWith("HTTP/1.1 400"));
  RawSocket socket(port_);
  socket.send(upgrade(port_, "", "/ws", "other.v9, swiftlet.v1"));
  EXPECT_THAT(socket.receive_head(), HasSubstr("Sec-WebSocket-Protocol: swiftlet.v1\r\n"));
}

TEST_F(RunningStation, refuses_more_clients_than_it_has_room_for) {
  start("", 2);
  RawSocket first(port_), second(port_);
  for (RawSocket* client : {&first, &second}) {
    client->send(upgrade(port_));
    EXPECT_THAT(client->receive_head(), StartsWith("HTTP/1.1 101"));
  }
  EXPECT_THAT(answer_to(upgrade(port_)), StartsWith("HTTP/1.1 503"));
}

TEST_F(RunningStation, hostile_clients_are_closed_and_others_do_not_notice) {
  flight_.step();
  start();
  RawSocket good(port_);
  good.send(upgrade(port_));
  EXPECT_THAT(good.receive_head(), StartsWith("HTTP/1.1 101"));
  WireReader client;
  expect_complete(good, client);

  const std::string frame_of_64k = RawSocket::frame(2, std::string(60'000, 'x'));
  std::string flood;
  for (int i = 0; i < 500; ++i) flood += RawSocket::frame(2, std::string("\2\0\0\0", 4));
  const std::vector<std::string> before_it_is_let_in{
      "\x16\x03\x01\x02\x00garbage of another protocol\r\n\r\n",
      "GET / HTTP/9.9\r\n\r\n",
      "GET /" + std::string(100'000, 'a') + " HTTP/1.1\r\n\r\n",
      get(port_, "X: " + std::string(20'000, 'a') + "\r\n"),
      "POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 99999999999\r\n\r\n",
      upgrade(port_) + RawSocket::frame(2, std::string("\2\0\0\0", 4)),
  };
  for (const std::string& attack : before_it_is_let_in) {
    EXPECT_THAT(answer_to(attack), Not(HasSubstr("200 OK"))) << attack.substr(0, 40);
    flight_.step();
    expect_complete(good, client);
    if (HasFailure()) return;
  }

  const std::vector<std::string> known{
      frame_of_64k,
      RawSocket::frame(1, "hello"),
      RawSocket::frame(2, std::string("\xff\xff\xff\xff", 4)),
      std::string("\x82\x04\x02\x00\x00\x00", 6),  // not masked
      std::string(14, '\xff'),
      flood,
  };
  for (std::size_t i = 0; i < 40; ++i) {
    std::string bytes = i < known.size() ? known[i] : random_bytes();
    RawSocket socket(port_);
    socket.send(upgrade(port_));
    EXPECT_THAT(socket.receive_head(), StartsWith("HTTP/1.1 101"));
    socket.send(bytes);
    flight_.step();
    expect_complete(good, client);
    if (HasFailure()) return;
    if (i >= known.size()) continue;  // noise may be the beginning of something good
    int opcode = 0;
    while (opcode != 8 && opcode != -1) opcode = socket.next_message().first;  // sent away
  }
  EXPECT_THAT(answer_to(get(port_)), StartsWith("HTTP/1.1 200 OK"));
}

TEST_F(RunningStation, a_client_that_reads_nothing_does_not_hold_up_the_others) {
  start();
  RawSocket stalled(port_);
  stalled.send(upgrade(port_));
  RawSocket good(port_);
  good.send(upgrade(port_));
  EXPECT_THAT(good.receive_head(), StartsWith("HTTP/1.1 101"));
  WireReader client;
  for (int i = 0; i < 300; ++i) flight_.step();
  expect_complete(good, client);
  while (!HasFailure() && client.digest(small_info().header.scale.thresholds) != flight_.truth()) {
    expect_complete(good, client);
  }
}

TEST_F(RunningStation, says_where_it_cannot_listen) {
  start();
  StationOptions options;
  options.listen.port = port_;
  LiveFeed feed;
  const auto second = Station::start(options, feed);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().text(), HasSubstr("cannot listen there"));
  EXPECT_THAT(station_->urls().front(), StartsWith("http://127.0.0.1:"));
}

}  // namespace
}  // namespace swiftlet::station
#endif
