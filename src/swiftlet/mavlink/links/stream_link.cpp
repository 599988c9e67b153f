// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_MAVLINK
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/serial_port.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <vector>

#include "swiftlet/mavlink/links/link_private.hpp"

namespace swiftlet::mavlink {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostWaiting = 16'384;  // bytes: a fifth of a second of a fast serial line

/// A stream of bytes that is opened again whenever it breaks.
template <class Stream>
class StreamLink : public Link {
 public:
  StreamLink(const LinkAddress& address, LinkHost host)
      : Link(std::move(host)), address_(address), stream_(host_.io), retry_(host_.io) {}

  void start() override { open(); }

  void send(std::span<const std::uint8_t> frame) override {
    if (!is_ready_ || waiting_.size() + frame.size() > kMostWaiting) {
      ++tally_.unsent;
      return;
    }
    ++tally_.sent;
    waiting_.insert(waiting_.end(), frame.begin(), frame.end());
    if (sending_.empty()) write();
  }

 protected:
  /// Ends in opened().
  virtual void open() = 0;

  void opened(error_code error) {
    if (error == asio::error::operation_aborted) return;
    if (error) return close(error);
    is_ready_ = true;
    parser_.start_anew();
    tell(true, "");
    read();
  }

  const LinkAddress address_;
  Stream stream_;

 private:
  void read() {
    stream_.async_read_some(asio::buffer(read_), [this](error_code error, std::size_t size) {
      if (error == asio::error::operation_aborted) return;
      if (error) return close(error);
      parser_.feed({read_.data(), size}, LinkHost::now(),
                   [this](const Packet& packet) { host_.received(packet); });
      read();
    });
  }

  void write() {
    std::swap(sending_, waiting_);
    asio::async_write(stream_, asio::buffer(sending_), [this](error_code error, std::size_t) {
      sending_.clear();
      if (error || !is_ready_) return;  // read() tells why
      if (!waiting_.empty()) write();
    });
  }

  void close(error_code why) {
    is_ready_ = false;
    waiting_.clear();
    error_code ignored;
    stream_.close(ignored);
    tell(false, why.message());
    retry_.expires_after(host_.options.retry);
    retry_.async_wait([this](error_code error) {
      if (!error) open();
    });
  }

  asio::steady_timer retry_;
  bool is_ready_ = false;
  std::array<std::uint8_t, 4096> read_{};
  std::vector<std::uint8_t> waiting_, sending_;
};

class TcpLink final : public StreamLink<tcp::socket> {
 public:
  using StreamLink::StreamLink;

 private:
  void open() override {
    const tcp::endpoint place(asio::ip::make_address(address_.host), address_.port);
    stream_.async_connect(place, [this](error_code error) {
      error_code ignored;
      if (!error) stream_.set_option(tcp::no_delay(true), ignored);
      opened(error);
    });
  }
};

class SerialLink final : public StreamLink<asio::serial_port> {
 public:
  using StreamLink::StreamLink;

 private:
  void open() override {
    using Port = asio::serial_port_base;
    error_code error;
    stream_.open(address_.device, error);
    if (!error) stream_.set_option(Port::baud_rate(address_.baud), error);
    if (!error) stream_.set_option(Port::character_size(8), error);
    if (!error) stream_.set_option(Port::parity(Port::parity::none), error);
    if (!error) stream_.set_option(Port::stop_bits(Port::stop_bits::one), error);
    if (!error) stream_.set_option(Port::flow_control(Port::flow_control::none), error);
    // Others that look for modems would write into the line.
    if (!error) (void)::ioctl(stream_.native_handle(), TIOCEXCL);
    opened(error);
  }
};

}  // namespace

std::unique_ptr<Link> make_tcp_link(const LinkAddress& address, LinkHost host) {
  return std::make_unique<TcpLink>(address, std::move(host));
}

std::unique_ptr<Link> make_serial_link(const LinkAddress& address, LinkHost host) {
  return std::make_unique<SerialLink>(address, std::move(host));
}

}  // namespace swiftlet::mavlink
#endif
