// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "swiftlet/station/http_answer.hpp"
#include "swiftlet/station/map_desk_private.hpp"
#include "swiftlet/station/socket_session_private.hpp"

namespace swiftlet::station {

/// What a connection asks of the server.
struct HttpHost {
  const AccessRules& rules;
  /// A viewer for one of the subprotocols offered, and the one that was chosen; nullopt if none of
  /// them is spoken here.
  struct Chosen {
    std::unique_ptr<Viewer> viewer;
    std::string subprotocol;
    SocketSession::Limits limits;
  };
  std::function<std::optional<Chosen>(std::string_view offered)> choose;
  std::function<bool()> has_room;  ///< for one more client
  std::function<void(std::shared_ptr<SocketSession>)> opened;
  std::function<void(MapDesk::Ready)> fetch_map;
};

/// One connection: answers plain requests, and turns into a SocketSession when asked to. Does
/// nothing but refuse when access is not given.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  /// `alive` lives as long as the connection, so that the server can count it.
  HttpSession(boost::asio::ip::tcp::socket&& socket, const HttpHost& host,
              std::shared_ptr<void> alive)
      : stream_(std::move(socket)), host_(host), alive_(std::move(alive)) {}
  void read();

 private:
  struct Sending;

  void respond();
  void upgrade();
  void send(const HttpAnswer& answer, SharedBytes body = nullptr);
  void send_map(HttpAnswer answer, const Expected<SharedBytes>& file);
  void write_on(const std::shared_ptr<Sending>& sending);

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer inbox_;
  const HttpHost& host_;
  std::shared_ptr<void> alive_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
};

}  // namespace swiftlet::station
