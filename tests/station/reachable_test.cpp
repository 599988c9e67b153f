// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/reachable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet::station {
namespace {

using ::testing::ElementsAre;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> texts(const ListenAddress& listen, const OwnAddresses& own) {
  std::vector<std::string> all;
  for (const ListenAddress& place : reachable_at(listen, own)) all.push_back(place.text());
  return all;
}

TEST(Reachable, tells_addresses_to_open_where_it_listens_everywhere) {
  const OwnAddresses own{{"192.168.1.7", "2001:db8::7"}, "drone"};
  EXPECT_THAT(texts({"0.0.0.0", 80}, own), ElementsAre("192.168.1.7:80", "drone:80"));
  EXPECT_THAT(texts({"::", 80}, own),
              ElementsAre("192.168.1.7:80", "[2001:db8::7]:80", "drone:80"));
  EXPECT_THAT(texts({"0:0::0", 80}, own), Not(ElementsAre("[0:0::0]:80")));
}

TEST(Reachable, tells_the_very_address_where_it_is_one) {
  const OwnAddresses own{{"192.168.1.7"}, "drone"};
  EXPECT_THAT(texts({"127.0.0.1", 80}, own), ElementsAre("127.0.0.1:80"));
  EXPECT_THAT(texts({"192.168.1.7", 80}, own), ElementsAre("192.168.1.7:80"));
}

TEST(Reachable, tells_this_machine_where_there_is_no_other_address) {
  EXPECT_THAT(texts({"0.0.0.0", 80}, {}), ElementsAre("127.0.0.1:80"));
}

TEST(Reachable, own_addresses_can_be_opened_from_elsewhere) {
  for (const std::string& address : own_addresses().numeric) {
    EXPECT_THAT(address, Not(StartsWith("127.")));
    EXPECT_THAT(address, Not(StartsWith("fe80")));
    EXPECT_TRUE(parse_listen_address("[" + address + "]:1")) << address;
  }
}

}  // namespace
}  // namespace swiftlet::station
