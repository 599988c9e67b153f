// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "swiftlet/station/client_protocol.hpp"
#include "swiftlet/station/state/token_bucket.hpp"

namespace swiftlet::station {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// One WebSocket: carries what its protocol wants sent, one message at a time, and hands on what
/// the client says. A client that does not keep to the rules, or takes nothing for long, is closed.
class SocketSession : public std::enable_shared_from_this<SocketSession> {
 public:
  struct Limits {
    std::size_t max_message = 0;   ///< from the client [bytes]
    double messages_per_s = 20.0;  ///< from the client
    double controls_per_s = 2.0;  ///< pings and pongs from the client; browsers send a few a minute
    std::chrono::seconds stall{30};  ///< a message that has not left by then
  };

  /// Makes the protocol when the client is in: it takes the map as it is then, and whoever is told
  /// of the client then must tell it every change from there on.
  using MakeProtocol = std::function<std::unique_ptr<ClientProtocol>()>;

  /// Holds `place` for as long as it lives.
  SocketSession(boost::beast::tcp_stream&& stream, MakeProtocol make_protocol, const Limits& limits,
                std::shared_ptr<void> place)
      : socket_(std::move(stream)),
        make_protocol_(std::move(make_protocol)),
        limits_(limits),
        place_(std::move(place)) {}

  /// Answers the handshake, choosing this subprotocol; `opened` is called when the client is in.
  void accept(const HttpRequest& request, const std::string& subprotocol,
              std::function<void(std::shared_ptr<SocketSession>)> opened);
  /// Sends what there is to send, unless a message is still on its way.
  void pump();
  /// Once a tick: closes a client that takes nothing.
  void check(ClientProtocol::Time now);
  [[nodiscard]] bool is_open() const { return is_open_; }
  /// REQUIRES: the client is in.
  [[nodiscard]] ClientProtocol& protocol() { return *protocol_; }

 private:
  void read();
  void received(std::size_t size);
  void count_control_frame();
  void close(boost::beast::websocket::close_code code, const std::string& reason);
  void drop();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::beast::flat_buffer inbox_;
  MakeProtocol make_protocol_;
  std::unique_ptr<ClientProtocol> protocol_;
  Limits limits_;
  std::shared_ptr<void> place_;
  TokenBucket allowance_;
  TokenBucket control_allowance_;
  Outgoing going_;  // while it is being written
  ClientProtocol::Time since_{};
  bool is_writing_ = false;
  bool is_open_ = false;
};

}  // namespace swiftlet::station
