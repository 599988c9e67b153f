// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "support/no_threads.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/mavlink/links/link_thread.hpp"

namespace swiftlet::mavlink {
namespace {

using namespace std::chrono_literals;

/// Counts what comes, and sends a heartbeat every tick.
class CountingUser final : public LinkUser {
 public:
  void received(std::size_t, const Packet& packet, FrameOutlet&) override {
    change([&] {
      ++packets_;
      last_ = packet;
    });
  }
  void link_changed(std::size_t, bool is_open, const std::string& what) override {
    change([&] {
      ++(is_open ? opened_ : failed_);
      why_ = what;
    });
  }
  void tick(FrameOutlet& out) override { out.send(0, writer_.write(Heartbeat{}, {})); }

  /// True as soon as a condition holds; false if it does not for so long.
  bool wait(const std::function<bool(const CountingUser&)>& condition,
            std::chrono::milliseconds patience = 10s) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return condition(*this); });
  }

  std::size_t packets_ = 0, opened_ = 0, failed_ = 0;  // with the lock, in wait()
  std::string why_;
  Packet last_;

 private:
  void change(const std::function<void()>& what) {
    const std::scoped_lock lock(mutex_);
    what();
    changed_.notify_all();
  }
  PacketWriter writer_{{1, 1}};
  std::mutex mutex_;
  std::condition_variable changed_;
};

bool has_heard_ten(const CountingUser& user) { return user.packets_ >= 10; }

LinkAddress at(std::string_view text) { return *parse_link_address(text); }

/// A UDP or TCP port of this computer that was free a moment ago.
std::uint16_t free_port(int type = SOCK_DGRAM) {
  const int probe = ::socket(AF_INET, type, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  (void)::bind(probe, reinterpret_cast<const sockaddr*>(&place), size);
  (void)::getsockname(probe, reinterpret_cast<sockaddr*>(&place), &size);
  ::close(probe);
  return ntohs(place.sin_port);
}

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return place;
}

LinkOptions links(std::string_view address) {
  return {.links = {at(address)}, .retry = 20ms, .peer_silence = 200ms};
}

TEST(LinkAddress, reads_what_it_writes) {
  for (const std::string text :
       {"udp:127.0.0.1:14540", "udpin:0.0.0.0:14550", "udpin:0.0.0.0:1?peer=10.0.0.7",
        "udp:[::1]:9", "tcp:192.168.1.2:5760", "serial:/dev/ttyACM0?baud=57600"})
    EXPECT_EQ(at(text).text(), text);
  EXPECT_EQ(at("serial:/dev/ttyACM0").baud, 921'600U);
  EXPECT_EQ(at("udp:localhost:5").host, "127.0.0.1");
}

TEST(LinkAddress, refuses_what_cannot_be_meant) {
  for (const std::string_view text :
       {"", "udp", "udp:", "udp:14540", "udp:127.0.0.1", "udp:127.0.0.1:0", "udp:127.0.0.1:65536",
        "udp:example.org:5", "can:1", "serial:", "serial:/dev/x?baud=1", "serial:/dev/x?peer=::1",
        "udpin:0.0.0.0:5?peer=here", "udp:::1:5", "tcp:1.2.3.4:5?x"})
    EXPECT_FALSE(parse_link_address(text)) << text;
}

TEST(LinkThread, refuses_a_port_where_anybody_could_speak) {
  CountingUser user;
  EXPECT_EQ(LinkThread::start(links("udpin:0.0.0.0:14540"), user).error().code, ErrorCode::kUsage);
  EXPECT_EQ(LinkThread::start({}, user).error().code, ErrorCode::kUsage);
}

#if SWIFTLET_HAS_MAVLINK
TEST(LinkThread, speaks_both_ways_over_udp_with_whoever_speaks_first) {
  const auto port = std::to_string(free_port());
  CountingUser listener, caller;
  const auto listens = LinkThread::start(links("udpin:127.0.0.1:" + port), listener);
  ASSERT_TRUE(listens) << listens.error().text();
  const auto calls = LinkThread::start(links("udp:127.0.0.1:" + port), caller);
  ASSERT_TRUE(calls) << calls.error().text();
  EXPECT_TRUE(listener.wait(has_heard_ten));
  EXPECT_TRUE(caller.wait(has_heard_ten));
}

TEST(LinkThread, does_not_read_others_while_its_peer_speaks_and_takes_another_after_its_silence) {
  const std::uint16_t port = free_port();
  const auto address = std::to_string(port);
  CountingUser listener, second;
  auto listens = LinkThread::start(links("udpin:127.0.0.1:" + address), listener);
  ASSERT_TRUE(listens);
  {
    CountingUser first;
    const auto calls = LinkThread::start(links("udp:127.0.0.1:" + address), first);
    ASSERT_TRUE(listener.wait(has_heard_ten));
    const auto also_calls = LinkThread::start(links("udp:127.0.0.1:" + address), second);
    ASSERT_TRUE(first.wait([](const auto& user) { return user.packets_ >= 40; }));
    while ((*listens)->tally(0).strangers == 0) std::this_thread::yield();
    EXPECT_TRUE(second.wait([](const auto& user) { return user.packets_ == 0; }));
  }
  CountingUser third;
  const auto calls = LinkThread::start(links("udp:127.0.0.1:" + address), third);
  EXPECT_TRUE(third.wait(has_heard_ten));
}

TEST(LinkThread, tells_of_a_port_that_is_taken) {
  const auto address = "udpin:127.0.0.1:" + std::to_string(free_port());
  CountingUser user;
  const auto first = LinkThread::start(links(address), user);
  ASSERT_TRUE(first);
  const auto second = LinkThread::start(links(address), user);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kIo);
  EXPECT_NE(second.error().text().find(address), std::string::npos);
}

#ifdef SWIFTLET_CAN_LACK_THREADS
TEST(LinkThread, says_so_if_the_system_has_no_thread_for_it) {
  CountingUser user;
  const auto options = links("udp:127.0.0.1:" + std::to_string(free_port()));
  const test::NoThreads none;
  const auto started = LinkThread::start(options, user);
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kOutOfMemory);
}
#endif

TEST(LinkThread, opens_a_tcp_link_when_the_other_side_comes_and_again_when_it_has_gone) {
  const std::uint16_t port = free_port(SOCK_STREAM);
  CountingUser user;
  const auto link = LinkThread::start(links("tcp:127.0.0.1:" + std::to_string(port)), user);
  ASSERT_TRUE(link);
  EXPECT_TRUE(user.wait([](const auto& u) { return u.failed_ == 1; }));
  const int server = ::socket(AF_INET, SOCK_STREAM, 0);
  const int yes = 1;
  (void)::setsockopt(server, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const sockaddr_in place = loopback(port);
  ASSERT_EQ(::bind(server, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  ASSERT_EQ(::listen(server, 1), 0);
  PacketWriter writer({7, 1});
  for (std::size_t time = 1; time <= 3; ++time) {
    const int session = ::accept(server, nullptr, nullptr);
    const auto frame = writer.write(Heartbeat{.type = 2}, {});
    ASSERT_GT(::write(session, frame.bytes().data(), frame.bytes().size()), 0);
    EXPECT_TRUE(user.wait([&](const auto& u) { return u.packets_ == time && u.opened_ == time; }));
    std::uint8_t byte = 0;
    EXPECT_EQ(::read(session, &byte, 1), 1);
    EXPECT_EQ(byte, wire::kStart);
    ::close(session);
  }
  ::close(server);
}

/// A serial line whose other end is ours.
class PseudoTerminal {
 public:
  PseudoTerminal() : fd_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    (void)::grantpt(fd_);
    (void)::unlockpt(fd_);
    std::array<char, 128> name{};
    (void)::ptsname_r(fd_, name.data(), name.size());
    name_ = name.data();
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;
  ~PseudoTerminal() { ::close(fd_); }
  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  int fd_;
  std::string name_;
};

TEST(LinkThread, speaks_over_a_serial_line_that_is_plugged_in_later_and_pulled) {
  const test::TempFolder folder;
  const auto device = folder / "ttyACM0";
  CountingUser user;
  const auto link = LinkThread::start(links("serial:" + device.string() + "?baud=57600"), user);
  ASSERT_TRUE(link);
  EXPECT_TRUE(user.wait([](const auto& u) { return u.failed_ == 1; }));
  for (std::size_t time = 1; time <= 2; ++time) {
    const PseudoTerminal line;
    std::filesystem::create_symlink(line.name(), device);
    EXPECT_TRUE(user.wait([&](const auto& u) { return u.opened_ == time; }));
    // Every byte value passes: a line that is not raw would change some.
    PacketWriter writer({7, 1});
    Odometry odometry;
    for (std::size_t i = 0; i < 21; ++i)
      odometry.pose_covariance[i] =
          std::bit_cast<float>(0x0A0D1103U + 0x04040404U * static_cast<std::uint32_t>(i));
    const auto frame = writer.write(odometry, {});
    ASSERT_EQ(::write(line.fd(), frame.bytes().data(), frame.bytes().size()),
              static_cast<ssize_t>(frame.bytes().size()));
    EXPECT_TRUE(user.wait([&](const auto& u) { return u.packets_ == time; }));
    std::array<std::uint8_t, 64> heard{};
    EXPECT_GT(::read(line.fd(), heard.data(), heard.size()), 0);
    EXPECT_EQ(heard[0], wire::kStart);
    std::filesystem::remove(device);
  }
  EXPECT_TRUE(user.wait([](const auto& u) { return u.failed_ >= 2; }));
}

TEST(LinkThread, lets_nothing_in_that_a_flood_of_strangers_and_forgers_sends) {
  SigningKey key{1, 2, 3}, other{4, 5, 6};
  const std::uint16_t port = free_port();
  CountingUser user;
  LinkOptions options = links("udpin:127.0.0.1:" + std::to_string(port));
  options.key = key;
  const auto link = LinkThread::start(options, user);
  ASSERT_TRUE(link);
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in place = loopback(port);
  ASSERT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  PacketWriter forger({1, 1}, Signer(other)), plain({1, 1}), owner({1, 1}, Signer(key));
  const Stamp now{Nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
  for (int i = 0; i < 20'000; ++i) {
    const auto frame = i % 2 == 0 ? forger.write(Heartbeat{}, now) : plain.write(Heartbeat{}, now);
    (void)::send(socket, frame.bytes().data(), frame.bytes().size(), 0);
  }
  const auto send = [&](const WireFrame& frame) {
    (void)::send(socket, frame.bytes().data(), frame.bytes().size(), 0);
  };
  // The system drops what comes while the flood fills its buffer; the owner says it again.
  WireFrame frame;
  int said = 0;
  do {
    frame = owner.write(Heartbeat{.custom_mode = 9}, now);
    send(frame);
  } while (!user.wait([](const auto& u) { return u.packets_ > 0; }, 20ms) && ++said < 500);
  while ((*link)->tally(0).in.replayed < 2) {
    send(frame);
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(user.last_.as<Heartbeat>()->custom_mode, 9U);
  EXPECT_GT((*link)->tally(0).in.forged, 0U);
  EXPECT_GT((*link)->tally(0).in.unsigned_packets, 0U);
  EXPECT_LE((*link)->tally(0).in.packets, static_cast<std::size_t>(said) + 1);
  ::close(socket);
}
#endif

}  // namespace
}  // namespace swiftlet::mavlink
