// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <chrono>

#include "swiftlet/station/http/http_session_private.hpp"
#include "swiftlet/station/http/server_private.hpp"

namespace swiftlet::station {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::uint32_t kMaxHeader_bytes = 8 * 1024;
constexpr std::chrono::seconds kNextRequest{10};
constexpr std::chrono::seconds kStall{30};
/// What may wait in the system for one connection: of the live map, more than that is old by the
/// time it arrives; of the file, the rest waits in what all share.
constexpr int kSendBuffer_bytes = 128 * 1024;

using Clock = std::chrono::steady_clock;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

Credentials credentials_of(const HttpRequest& request) {
  return {view(request[http::field::host]), view(request[http::field::origin]),
          view(request.target()), view(request[http::field::cookie]),
          view(request[http::field::authorization])};
}

/// Of IPv6 the first half, as one machine may use all addresses of the other.
std::string guesser_of(const boost::asio::ip::address& peer) {
  if (!peer.is_v6() || peer.to_v6().is_v4_mapped()) return peer.to_string();
  auto bytes = peer.to_v6().to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  return boost::asio::ip::make_address_v6(bytes).to_string();
}

/// For a WebSocket client that named none of them.
std::string languages() {
  std::string text = "ask for a subprotocol that is spoken here:";
  for (const Subprotocol& known : subprotocols()) text.append(" ").append(known.name);
  return text;
}

}  // namespace

HttpSession::HttpSession(boost::asio::ip::tcp::socket&& socket, const HttpHost& host)
    : stream_(std::move(socket)), host_(host) {
  beast::error_code error;
  const auto peer = stream_.socket().remote_endpoint(error).address();
  address_ = peer.to_string();
  guesser_ = guesser_of(peer);
  stream_.socket().set_option(boost::asio::socket_base::send_buffer_size(kSendBuffer_bytes), error);
}

void HttpSession::read(std::chrono::milliseconds timeout) {
  // Between two requests, too: whoever only waits must not hold the place of somebody who asks.
  is_known_ = false;
  download_.reset();
  place_ = host_.waiting.enter(guesser_, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->stream_.close();
  });
  parser_.emplace();
  parser_->header_limit(kMaxHeader_bytes);
  parser_->body_limit(0);
  stream_.expires_after(timeout);  // for the whole of it, however slowly it drips in
  http::async_read(stream_, inbox_, *parser_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) {
                     // Whatever is no request within the limits gets no answer.
                     if (!error) self->respond();
                   });
}

void HttpSession::respond() {
  const Credentials who = credentials_of(parser_->get());
  const Verdict verdict = host_.door.judge(guesser_, address_, who, Clock::now());
  if (verdict != Verdict::kAllowed) return send(refusal(verdict, who));
  auto place = host_.answers.take();
  if (!place) return send(busy_answer("too many others are being answered"));
  place_ = std::move(place);
  is_known_ = true;
  respond_to_known();
}

void HttpSession::respond_to_known() {
  const HttpRequest& request = parser_->get();
  if (beast::websocket::is_upgrade(request)) {
    upgrade();
    return;
  }
  const HttpQuestion question{view(request.method_string()), credentials_of(request),
                              view(request["Sec-Fetch-Site"])};
  const HttpAnswer found = answer(host_.rules, question, page_files());
  if (found.is_map) {
    fetch_map(found);
  } else {
    send(found);
  }
}

void HttpSession::fetch_map(const HttpAnswer& found) {
  download_ = host_.downloads.take();
  if (!download_) return send(busy_answer("too many others are taking the map file"));
  stream_.expires_never();  // it is we who take our time
  host_.fetch_map([self = shared_from_this(), found](const Expected<SharedBytes>& file) {
    self->send_map(found, file);
  });
}

void HttpSession::upgrade() {
  const HttpRequest& request = parser_->get();
  // No client speaks before it has been let in.
  if (inbox_.size() > 0) return send(plain_answer(400, "a client may not speak before the answer"));
  auto place = host_.sockets.take();
  if (!place) return send(busy_answer("as many look at the map as there is room for"));
  auto chosen = host_.choose(view(request[http::field::sec_websocket_protocol]));
  if (!chosen) return send(plain_answer(400, languages()));
  auto session = std::make_shared<SocketSession>(std::move(stream_), std::move(chosen->make),
                                                 chosen->limits, std::move(place));
  session->accept(
      request, chosen->subprotocol,
      [&host = host_](std::shared_ptr<SocketSession> opened) { host.opened(std::move(opened)); });
}

/// An answer on its way, and what its bytes lie in.
struct HttpSession::Sending {
  http::response<http::span_body<const std::uint8_t>> response;
  http::response_serializer<http::span_body<const std::uint8_t>> serializer{response};
  SharedBytes body;  // null: linked into the program
  bool goes_on = false;
};

void HttpSession::send_map(HttpAnswer answer, const Expected<SharedBytes>& file) {
  if (file) {
    answer.body = **file;
    return send(answer, *file);
  }
  if (file.error().code == ErrorCode::kOutOfMemory) return send(busy_answer(file.error().what));
  send(plain_answer(file.error().code == ErrorCode::kNotFound ? 404 : 500, file.error().text()));
}

void HttpSession::send(const HttpAnswer& answer, SharedBytes body) {
  const HttpRequest& request = parser_->get();
  auto sending = std::make_shared<Sending>();
  auto& response = sending->response;
  std::span<const std::uint8_t> bytes = answer.body;
  if (!answer.text.empty()) {
    body =
        std::make_shared<const std::vector<std::uint8_t>>(answer.text.begin(), answer.text.end());
    bytes = *body;
  }
  response.result(static_cast<http::status>(answer.status));
  response.version(request.version());
  for (const auto& [name, value] : answer.headers) response.set(name, value);
  if (request.method() != http::verb::head) {
    response.body() = {bytes.data(), bytes.size()};
  }
  response.content_length(bytes.size());
  sending->body = std::move(body);
  sending->goes_on = answer.status == 200 && request.keep_alive();
  response.keep_alive(sending->goes_on);
  write_on(sending);
}

/// Piece by piece: over a slow link the whole takes long, and only a client that takes nothing at
/// all is given up.
void HttpSession::write_on(const std::shared_ptr<Sending>& sending) {
  stream_.expires_after(is_known_ ? kStall : host_.timeout);
  http::async_write_some(
      stream_, sending->serializer,
      [self = shared_from_this(), sending](beast::error_code error, std::size_t) {
        if (error) return;
        if (!sending->serializer.is_done()) return self->write_on(sending);
        if (sending->goes_on) return self->read(kNextRequest);
        beast::error_code ignored;
        self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
      });
}

}  // namespace swiftlet::station
