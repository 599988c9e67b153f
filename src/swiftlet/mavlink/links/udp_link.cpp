// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_MAVLINK
#include <fmt/format.h>

#include <boost/asio/ip/udp.hpp>

#include "swiftlet/mavlink/links/link_private.hpp"

namespace swiftlet::mavlink {
namespace {

namespace asio = boost::asio;
using asio::ip::udp;
using Clock = std::chrono::steady_clock;

/// To a named peer, or to whoever speaks first at a port of ours: the first whose packet is sound,
/// and signed if there is a key. As long as it speaks, nobody else is read.
class UdpLink final : public Link {
 public:
  UdpLink(const LinkAddress& address, LinkHost host)
      : Link(std::move(host)), address_(address), socket_(host_.io) {}

  Status open() {
    const udp::endpoint place(asio::ip::make_address(address_.host), address_.port);
    boost::system::error_code error;
    socket_.open(place.protocol(), error);
    if (!error && learns()) socket_.bind(place, error);
    if (!error && !learns()) socket_.connect(place, error);
    if (!error) socket_.non_blocking(true, error);
    if (!error) return Done{};
    return fail(ErrorCode::kIo, address_.text(), error.message(),
                learns() ? "is another program listening there? choose another port" : "");
  }

  void start() override {
    tell(true, "");
    receive();
  }

  void send(std::span<const std::uint8_t> frame) override {
    boost::system::error_code error;
    const auto bytes = asio::buffer(frame.data(), frame.size());
    if (!learns()) {
      socket_.send(bytes, 0, error);
    } else if (has_peer_) {
      socket_.send_to(bytes, peer_, 0, error);
    } else {
      error = asio::error::not_connected;
    }
    ++(error ? tally_.unsent : tally_.sent);
  }

 private:
  [[nodiscard]] bool learns() const { return address_.kind == LinkKind::kUdpListen; }

  void receive() {
    socket_.async_receive_from(asio::buffer(datagram_), sender_,
                               [this](boost::system::error_code error, std::size_t size) {
                                 if (error == asio::error::operation_aborted) return;
                                 // Refused: nobody listens there yet.
                                 if (!error) take({datagram_.data(), size});
                                 receive();
                               });
  }

  void take(std::span<const std::uint8_t> datagram) {
    if (learns() && !may_speak()) {
      ++tally_.strangers;
      return;
    }
    parser_.start_anew();
    bool is_sound = false;
    parser_.feed(datagram, LinkHost::now(), [&](const Packet& packet) {
      is_sound = true;
      host_.received(packet);
    });
    if (!learns() || !is_sound) return;
    has_peer_ = true;
    peer_ = sender_;
    heard_ = Clock::now();
  }

  [[nodiscard]] bool may_speak() const {
    const bool is_named =
        address_.peer.empty() || sender_.address() == asio::ip::make_address(address_.peer);
    if (!is_named) return false;
    return !has_peer_ || sender_ == peer_ || Clock::now() - heard_ > host_.options.peer_silence;
  }

  const LinkAddress address_;
  udp::socket socket_;
  udp::endpoint sender_, peer_;
  bool has_peer_ = false;
  Clock::time_point heard_{};
  std::array<std::uint8_t, 2048> datagram_{};
};

}  // namespace

Expected<std::unique_ptr<Link>> make_udp_link(const LinkAddress& address, LinkHost host) {
  auto link = std::make_unique<UdpLink>(address, std::move(host));
  if (auto open = link->open(); !open) return forward_error(std::move(open));
  return link;
}

}  // namespace swiftlet::mavlink
#endif
