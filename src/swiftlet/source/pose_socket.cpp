// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/pose_socket.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <thread>
#include <utility>

#include "swiftlet/source/pose_line.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMaxDatagram = 65'536;
constexpr auto kComplainEvery = std::chrono::seconds(1);

/// A file descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

class PoseSocket final : public LiveStream {
 public:
  PoseSocket(Descriptor socket, Descriptor wake, std::string name, BodyAxes axes, LiveSink& sink)
      : socket_(std::move(socket)),
        wake_(std::move(wake)),
        name_(std::move(name)),
        axes_(axes),
        sink_(sink),
        thread_([this] { receive(); }) {}
  PoseSocket(const PoseSocket&) = delete;
  PoseSocket& operator=(const PoseSocket&) = delete;
  ~PoseSocket() override {
    (void)eventfd_write(wake_.get(), 1);
    thread_.join();
  }

 private:
  void receive() {
    std::array<pollfd, 2> waited{{{socket_.get(), POLLIN, 0}, {wake_.get(), POLLIN, 0}}};
    std::string buffer(kMaxDatagram, '\0');
    while (true) {
      if (::poll(waited.data(), waited.size(), -1) < 0 && errno != EINTR) return;
      if (waited[1].revents != 0) return;
      if (waited[0].revents == 0) continue;
      const ssize_t bytes = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (bytes > 0) take(std::string_view(buffer.data(), static_cast<std::size_t>(bytes)));
    }
  }

  void take(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      take_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  void take_line(std::string_view line) {
    if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.starts_with('#')) return;
    const auto pose = parse_pose_line(line, axes_);
    if (pose) return sink_.push(*pose);
    const HostTime now = HostTime::clock::now();
    if (complained_ && now - *complained_ < kComplainEvery) return;
    complained_ = now;
    sink_.note({RigEventKind::kBadPose, name_, pose.error().text()});
  }

  Descriptor socket_, wake_;
  const std::string name_;
  const BodyAxes axes_;
  LiveSink& sink_;
  std::optional<HostTime> complained_;
  std::thread thread_;
};

}  // namespace

Expected<LiveStreamPtr> listen_for_poses(std::uint16_t port, BodyAxes axes, LiveSink& sink) {
  const std::string name = fmt::format("poses on UDP port {}", port);
  const auto refused = [&] {
    return fail(ErrorCode::kIo, name, std::generic_category().message(errno),
                "is another program listening there? choose another port");
  };
  Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return refused();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  // The interface of sockets takes every kind of address by a pointer to the common head.
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return refused();
  Descriptor wake(::eventfd(0, EFD_CLOEXEC));
  if (wake.get() < 0) return refused();
  return std::make_unique<PoseSocket>(std::move(socket), std::move(wake), name, axes, sink);
}

}  // namespace swiftlet
