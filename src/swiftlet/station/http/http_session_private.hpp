// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "swiftlet/station/http/door.hpp"
#include "swiftlet/station/http/http_answer.hpp"
#include "swiftlet/station/http/map_download_private.hpp"
#include "swiftlet/station/http/socket_session_private.hpp"
#include "swiftlet/station/http/waiting_room.hpp"
#include "swiftlet/station/places.hpp"

namespace swiftlet::station {

/// What a connection asks of the server.
struct HttpHost {
  const AccessRules& rules;
  Door& door;
  WaitingRoom& waiting;     ///< for who has not shown yet that he may look
  const Places& answers;    ///< for who has
  const Places& downloads;  ///< of the map file, among them
  const Places& sockets;
  std::chrono::milliseconds timeout;  ///< with a request
  /// A protocol for one of the subprotocols offered, and the one that was chosen; nullopt if none
  /// of them is spoken here.
  struct Chosen {
    SocketSession::MakeProtocol make;
    std::string subprotocol;
    SocketSession::Limits limits;
  };
  std::function<std::optional<Chosen>(std::string_view offered)> choose;
  std::function<void(std::shared_ptr<SocketSession>)> opened;
  std::function<void(MapDownload::Ready)> fetch_map;
};

/// One connection: answers plain requests, and turns into a SocketSession when asked to. Does
/// nothing but refuse when access is not given, and waits among strangers until it is.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(boost::asio::ip::tcp::socket&& socket, const HttpHost& host);
  /// Waits for a request.
  void read(std::chrono::milliseconds timeout);

 private:
  struct Sending;

  void respond();
  void respond_to_known();
  void upgrade();
  void fetch_map(const HttpAnswer& found);
  void send(const HttpAnswer& answer, SharedBytes body = nullptr);
  void send_map(HttpAnswer answer, const Expected<SharedBytes>& file);
  void write_on(const std::shared_ptr<Sending>& sending);

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer inbox_;
  const HttpHost& host_;
  std::string address_;
  std::string guesser_;                // what its tries are counted by
  std::shared_ptr<const void> place_;  // where it waits or is served
  std::shared_ptr<void> download_;
  bool is_known_ = false;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
};

}  // namespace swiftlet::station
