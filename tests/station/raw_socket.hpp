// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "swiftlet/station/page/wire.hpp"

namespace swiftlet::station {

/// A TCP connection to 127.0.0.1 that sends whatever the test says, right or wrong.
class RawSocket {
 public:
  explicit RawSocket(std::uint16_t port) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<sockaddr*>(&place), sizeof(place)), 0);
  }
  ~RawSocket() { close(descriptor_); }
  RawSocket(const RawSocket&) = delete;
  RawSocket& operator=(const RawSocket&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  void send(const std::string& bytes) const {
    (void)::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

  /// Bytes that have come, waiting for the first of them; empty at the end or after 5 s.
  std::string receive() {
    pollfd poll_for{descriptor_, POLLIN, 0};
    if (poll(&poll_for, 1, 5000) != 1) return {};
    std::array<char, 65536> buffer;
    const ssize_t n = recv(descriptor_, buffer.data(), buffer.size(), 0);
    return n > 0 ? std::string(buffer.data(), static_cast<std::size_t>(n)) : std::string{};
  }
  /// Everything up to the end.
  std::string receive_all() {
    std::string all;
    for (std::string part = receive(); !part.empty(); part = receive()) all += part;
    return all;
  }
  /// The head of an answer, up to the blank line; what is behind it stays for next_message().
  std::string receive_head() {
    while (pending_.find("\r\n\r\n") == std::string::npos) {
      const std::string part = receive();
      if (part.empty()) return std::exchange(pending_, {});
      pending_ += part;
    }
    const auto end = pending_.find("\r\n\r\n") + 4;
    std::string head = pending_.substr(0, end);
    pending_.erase(0, end);
    return head;
  }

  /// A frame of a WebSocket client: masked (with zeros), final.
  static std::string frame(int opcode, const std::string& payload) {
    std::string bytes{static_cast<char>(0x80 | opcode)};
    if (payload.size() < 126) {
      bytes += static_cast<char>(0x80 | payload.size());
    } else {
      bytes += static_cast<char>(0x80 | 126);
      bytes += static_cast<char>(payload.size() >> 8U);
      bytes += static_cast<char>(payload.size() & 255U);
    }
    return bytes + std::string(4, '\0') + payload;
  }

  /// The next frame that the server has sent: opcode and payload; opcode -1 at the end.
  std::pair<int, Bytes> next_message() {
    const auto want = [&](std::size_t size) {
      while (pending_.size() < size) {
        const std::string part = receive();
        if (part.empty()) return false;
        pending_ += part;
      }
      return true;
    };
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(pending_[i]); };
    if (!want(2)) return {-1, {}};
    std::size_t head = 2;
    std::size_t size = byte(1) & 127U;
    if (size >= 126) {
      const std::size_t extra = size == 126 ? 2 : 8;
      if (!want(2 + extra)) return {-1, {}};
      size = 0;
      for (std::size_t i = 0; i < extra; ++i) size = size << 8U | byte(2 + i);
      head += extra;
    }
    if (!want(head + size)) return {-1, {}};
    const int opcode = byte(0) & 15;
    Bytes payload(pending_.begin() + static_cast<std::ptrdiff_t>(head),
                  pending_.begin() + static_cast<std::ptrdiff_t>(head + size));
    pending_.erase(0, head + size);
    return {opcode, std::move(payload)};
  }

 private:
  int descriptor_;
  std::string pending_;
};

}  // namespace swiftlet::station
