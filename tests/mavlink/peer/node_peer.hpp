// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace swiftlet::test {

/// node-mavlink in a process of its own, and a UDP socket to it.
class NodePeer {
 public:
  /// Why it cannot be had on this machine; empty if it can.
  [[nodiscard]] static std::string missing() {
    if (!std::filesystem::exists(SWIFTLET_PEER "/node_modules/node-mavlink"))
      return "node-mavlink is not there; `npm ci` in tests/mavlink/peer fetches it";
    if (std::system("node --version > /dev/null 2>&1") != 0) return "there is no node";
    return {};
  }

  NodePeer() {
    std::array<int, 2> in{}, out{};
    if (::pipe(in.data()) != 0 || ::pipe(out.data()) != 0) ADD_FAILURE() << "no pipe";
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(in[0], STDIN_FILENO);
      ::dup2(out[1], STDOUT_FILENO);
      for (const int end : {in[0], in[1], out[0], out[1]}) ::close(end);
      ::execlp("node", "node", SWIFTLET_PEER "/peer.cjs", static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    stdin_ = in[1];
    std::string line;
    for (char c = 0; ::read(out[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(out[0]);
    connect_to(static_cast<std::uint16_t>(std::atoi(line.c_str())));
  }
  NodePeer(const NodePeer&) = delete;
  NodePeer& operator=(const NodePeer&) = delete;
  ~NodePeer() {
    ::close(stdin_);
    ::close(socket_);
    ::waitpid(child_, nullptr, 0);
  }

  void send(std::span<const std::uint8_t> bytes) const {
    (void)::send(socket_, bytes.data(), bytes.size(), 0);
  }
  void send(std::string_view text) const { (void)::send(socket_, text.data(), text.size(), 0); }
  /// The next datagram; empty if none comes within five seconds.
  [[nodiscard]] std::string receive() const {
    std::string datagram(4096, '\0');
    const ssize_t size = ::recv(socket_, datagram.data(), datagram.size(), 0);
    datagram.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return datagram;
  }

 private:
  void connect_to(std::uint16_t port) {
    socket_ = ::socket(AF_INET, SOCK_DGRAM, 0);
    const timeval patience{5, 0};
    (void)::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0)
      ADD_FAILURE() << "no way to the peer's port " << port;
  }

  pid_t child_ = -1;
  int stdin_ = -1;
  int socket_ = -1;
};

}  // namespace swiftlet::test
