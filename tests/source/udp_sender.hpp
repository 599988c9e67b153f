// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace swiftlet::test {

/// Sends datagrams to a port of this computer that was free a moment ago.
class UdpSender {
 public:
  UdpSender() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const int probe = ::socket(AF_INET, SOCK_DGRAM, 0);
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    (void)::bind(probe, reinterpret_cast<const sockaddr*>(&address_), size);
    (void)::getsockname(probe, reinterpret_cast<sockaddr*>(&address_), &size);
    ::close(probe);
  }
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;
  ~UdpSender() { ::close(socket_); }

  [[nodiscard]] std::uint16_t port() const { return ntohs(address_.sin_port); }
  void send(std::string_view text) const {
    (void)::sendto(socket_, text.data(), text.size(), 0,
                   reinterpret_cast<const sockaddr*>(&address_), sizeof address_);
  }

 private:
  int socket_;
  sockaddr_in address_{};
};

/// A datagram to a socket in the file system.
inline void send_to_path(const std::string& path, std::string_view text) {
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  (void)::sendto(socket, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&address),
                 sizeof address);
  ::close(socket);
}

/// What a program leaves that was killed while it listened.
inline void leave_dead_socket(const std::string& path) {
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  (void)::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  ::close(socket);
}

}  // namespace swiftlet::test
