// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live/pose_socket.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/base/start_thread.hpp"
#include "swiftlet/source/live/pose_guard.hpp"
#include "swiftlet/source/rig/pose_line.hpp"

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
  PoseSocket(Descriptor socket, Descriptor wake, const PoseAddress& address,
             std::optional<PoseGuard> guard, BodyAxes axes, LiveSink& sink)
      : socket_(std::move(socket)),
        wake_(std::move(wake)),
        name_(address.title()),
        path_(address.socket),
        guard_(std::move(guard)),
        axes_(axes),
        sink_(sink) {}
  PoseSocket(const PoseSocket&) = delete;
  PoseSocket& operator=(const PoseSocket&) = delete;
  ~PoseSocket() override {
    (void)eventfd_write(wake_.get(), 1);
    if (thread_.joinable()) thread_.join();
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  Status start() {
    auto thread = start_thread(name_, [this] { receive(); });
    if (!thread) return forward_error(std::move(thread));
    thread_ = std::move(*thread);
    return Done{};
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
    if (guard_) {
      const auto now = std::chrono::system_clock::now().time_since_epoch();
      const auto body = guard_->admit(text, Stamp{Nanoseconds(now).count()});
      if (!body) return deny(body.error());
      text = *body;
    }
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
    complain(unreadable_, RigEventKind::kBadPose, pose.error().text());
  }

  void deny(PoseDenial reason) {
    if (reason == PoseDenial::kForged)
      return complain(forged_, RigEventKind::kForgedPose,
                      "its hmac is missing or not of our key; who sends it?");
    complain(replayed_, RigEventKind::kReplayedPose,
             "it was sent before another one, or by a clock that is 30 s off");
  }

  /// Complaints of one kind, told once a second.
  struct Complaints {
    std::optional<HostTime> told{};
    std::size_t waiting = 0;
  };
  void complain(Complaints& kind, RigEventKind event, std::string what) {
    ++kind.waiting;
    const HostTime now = HostTime::clock::now();
    if (kind.told && now - *kind.told < kComplainEvery) return;
    kind.told = now;
    sink_.note({event, name_, std::move(what), std::exchange(kind.waiting, 0)});
  }

  Descriptor socket_, wake_;
  const std::string name_;
  const std::filesystem::path path_;
  std::optional<PoseGuard> guard_;  // the thread's, as are the complaints
  const BodyAxes axes_;
  LiveSink& sink_;
  Complaints unreadable_, forged_, replayed_;
  std::thread thread_;
};

bool is_loopback(const std::string& host) { return host.starts_with("127."); }

/// Binds a UDP port; errno tells why it could not.
bool bind_port(int socket, const PoseAddress& address) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(address.port);
  if (::inet_pton(AF_INET, address.host.c_str(), &place.sin_addr) != 1) {
    errno = EADDRNOTAVAIL;
    return false;
  }
  // The interface of sockets takes every kind of address by a pointer to the common head.
  return ::bind(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0;
}

/// Binds a name in the file system, for this user alone. One that a killed program has left is
/// taken over; one that somebody listens on, or that is no socket, is not.
bool bind_path(int socket, const std::filesystem::path& path) {
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  if (path.native().size() >= sizeof place.sun_path) {
    errno = ENAMETOOLONG;
    return false;
  }
  std::memcpy(place.sun_path, path.c_str(), path.native().size());
  const auto* head = reinterpret_cast<const sockaddr*>(&place);
  struct stat there {};
  if (::lstat(path.c_str(), &there) == 0 && S_ISSOCK(there.st_mode)) {
    const Descriptor probe(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const bool is_dead = ::connect(probe.get(), head, sizeof place) != 0 && errno == ECONNREFUSED;
    if (is_dead) ::unlink(path.c_str());
  }
  constexpr mode_t kOwner = S_IRUSR | S_IWUSR;
  return ::fchmod(socket, kOwner) == 0 && ::bind(socket, head, sizeof place) == 0 &&
         ::chmod(path.c_str(), kOwner) == 0;
}

}  // namespace

std::string PoseAddress::title() const {
  if (is_autopilot) return "poses of the autopilot";
  if (port == 0) return "poses on socket " + socket.string();
  if (is_loopback(host)) return fmt::format("poses on UDP port {}", port);
  return fmt::format("poses on UDP {}:{}", host, port);
}

std::optional<PoseAddress> parse_pose_address(std::string_view text) {
  constexpr std::string_view kUdp = "udp:", kUnix = "unix:";
  PoseAddress address;
  if (text == "mavlink") {
    address.is_autopilot = true;
    return address;
  }
  if (text.starts_with(kUnix)) {
    address.socket = text.substr(kUnix.size());
    return address.socket.empty() ? std::nullopt : std::optional(address);
  }
  if (!text.starts_with(kUdp)) return std::nullopt;
  text.remove_prefix(kUdp.size());
  if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    address.host = text.substr(0, colon);
    in_addr parsed{};
    if (::inet_pton(AF_INET, address.host.c_str(), &parsed) != 1) return std::nullopt;
    text.remove_prefix(colon + 1);
  }
  const auto port = number_from<std::uint16_t>(text);
  if (!port || *port == 0) return std::nullopt;
  address.port = *port;
  return address;
}

Expected<LiveStreamPtr> listen_for_poses(const PoseAddress& address, BodyAxes axes,
                                         LiveSink& sink) {
  if (address.is_autopilot) return std::make_unique<LiveStream>();
  std::optional<PoseGuard> guard;
  if (!address.key_file.empty()) {
    auto key = load_pose_key(address.key_file);
    if (!key) return forward_error(std::move(key));
    guard.emplace(std::move(*key));
  }
  const bool is_udp = address.port != 0;
  const auto refused = [&] {
    return fail(ErrorCode::kIo, address.title(), std::generic_category().message(errno),
                is_udp ? "is another program listening there? choose another port"
                       : "is another program listening there? choose another name");
  };
  Descriptor socket(::socket(is_udp ? AF_INET : AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return refused();
  const bool is_bound =
      is_udp ? bind_port(socket.get(), address) : bind_path(socket.get(), address.socket);
  if (!is_bound) return refused();
  Descriptor wake(::eventfd(0, EFD_CLOEXEC));
  if (wake.get() < 0) return refused();
  if (is_udp && !guard && !is_loopback(address.host)) {
    sink.note({RigEventKind::kOpenPort, address.title(),
               "whoever reaches it can move the map; give a key with pose_key=FILE (docs/rig.md)"});
  }
  auto poses = std::make_unique<PoseSocket>(std::move(socket), std::move(wake), address,
                                            std::move(guard), axes, sink);
  if (auto started = poses->start(); !started) return forward_error(std::move(started));
  return poses;
}

Expected<LiveStreamPtr> listen_for_poses(std::uint16_t port, BodyAxes axes, LiveSink& sink) {
  PoseAddress address;
  address.port = port;
  return listen_for_poses(address, axes, sink);
}

}  // namespace swiftlet
