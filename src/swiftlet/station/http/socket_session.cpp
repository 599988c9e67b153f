// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>

#include "swiftlet/station/http/socket_session_private.hpp"

namespace swiftlet::station {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

websocket::stream_base::timeout patience() {
  using namespace std::chrono_literals;
  return {.handshake_timeout = 10s, .idle_timeout = 60s, .keep_alive_pings = true};
}

}  // namespace

void SocketSession::accept(const HttpRequest& request, const std::string& subprotocol,
                           std::function<void(std::shared_ptr<SocketSession>)> opened) {
  auto& stream = beast::get_lowest_layer(socket_);
  stream.expires_never();  // from here on the WebSocket's own time-outs hold
  boost::system::error_code ignored;
  stream.socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  socket_.set_option(patience());
  socket_.set_option(websocket::stream_base::decorator([subprotocol](auto& response) {
    if (!subprotocol.empty()) response.set(beast::http::field::sec_websocket_protocol, subprotocol);
  }));
  socket_.auto_fragment(false);  // a message is one frame, as the packets are small already
  socket_.read_message_max(limits_.max_message);
  const auto now = Clock::now();
  allowance_ = TokenBucket(limits_.messages_per_s, 3.0 * limits_.messages_per_s, now);
  control_allowance_ = TokenBucket(limits_.controls_per_s, 10.0 * limits_.controls_per_s, now);
  // Held by the socket itself, which is a member.
  socket_.control_callback(
      [this](websocket::frame_type, beast::string_view) { count_control_frame(); });
  socket_.async_accept(
      request, [self = shared_from_this(), opened = std::move(opened)](beast::error_code error) {
        if (error) return;
        self->protocol_ = self->make_protocol_();
        self->is_open_ = true;
        opened(self);
        self->read();
        self->pump();
      });
}

void SocketSession::read() {
  socket_.async_read(inbox_,
                     [self = shared_from_this()](beast::error_code error, std::size_t size) {
                       if (error) {
                         self->is_open_ = false;
                         return;
                       }
                       self->received(size);
                     });
}

void SocketSession::received(std::size_t size) {
  const auto now = Clock::now();
  if (!allowance_.is_open(now)) {
    close(websocket::close_code::policy_error, "too many messages");
    return;
  }
  allowance_.spend(1.0);
  const auto data = inbox_.data();
  const std::span bytes(static_cast<const std::uint8_t*>(data.data()), size);
  const Status understood = protocol_->received(socket_.got_text(), bytes, now);
  inbox_.consume(inbox_.size());
  if (!understood) {
    close(websocket::close_code::protocol_error, understood.error().text());
    return;
  }
  pump();
  read();
}

/// Each ping makes the server write a pong, which no message counts.
void SocketSession::count_control_frame() {
  if (!is_open_) return;
  if (control_allowance_.is_open(Clock::now())) {
    control_allowance_.spend(1.0);
    return;
  }
  is_open_ = false;
  // Later, as the socket is in the middle of reading.
  boost::asio::post(socket_.get_executor(), [self = shared_from_this()] { self->drop(); });
}

void SocketSession::pump() {
  if (is_writing_ || !is_open_) return;
  auto message = protocol_->next(Clock::now());
  if (!message) return;
  going_ = std::move(*message);
  is_writing_ = true;
  since_ = Clock::now();
  socket_.text(going_.is_text);
  socket_.async_write(boost::asio::buffer(going_.data),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        self->is_writing_ = false;
                        if (error) {
                          self->is_open_ = false;
                        } else {
                          self->pump();
                        }
                      });
}

void SocketSession::check(ClientProtocol::Time now) {
  if (is_open_ && is_writing_ && now - since_ > limits_.stall) drop();
}

void SocketSession::drop() {
  is_open_ = false;
  beast::get_lowest_layer(socket_).close();
}

void SocketSession::close(websocket::close_code code, const std::string& reason) {
  is_open_ = false;
  if (is_writing_) {  // a close frame would have to wait for a client that may never read
    drop();
    return;
  }
  socket_.async_close(
      websocket::close_reason(
          code, beast::string_view(reason.data(), std::min<std::size_t>(reason.size(), 100))),
      [self = shared_from_this()](beast::error_code) {});
}

}  // namespace swiftlet::station
