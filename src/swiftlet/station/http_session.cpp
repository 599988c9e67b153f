// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <chrono>

#include "swiftlet/station/http_session_private.hpp"

namespace swiftlet::station {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::uint32_t kMaxHeader_bytes = 8 * 1024;
constexpr std::chrono::seconds kPatience{10};
constexpr std::chrono::seconds kStall{30};

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

Credentials credentials_of(const HttpRequest& request) {
  return {view(request[http::field::host]), view(request[http::field::origin]),
          view(request.target()), view(request[http::field::cookie]),
          view(request[http::field::authorization])};
}

}  // namespace

void HttpSession::read() {
  parser_.emplace();
  parser_->header_limit(kMaxHeader_bytes);
  parser_->body_limit(0);
  stream_.expires_after(kPatience);
  http::async_read(stream_, inbox_, *parser_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) {
                     // Whatever is no request within the limits gets no answer.
                     if (!error) self->respond();
                   });
}

void HttpSession::respond() {
  const HttpRequest& request = parser_->get();
  if (beast::websocket::is_upgrade(request)) {
    upgrade();
    return;
  }
  const HttpQuestion question{view(request.method_string()), credentials_of(request),
                              view(request["Sec-Fetch-Site"])};
  HttpAnswer found = answer(host_.rules, question, page_files());
  if (!found.is_map) return send(found);
  stream_.expires_never();  // it is we who take our time
  host_.fetch_map([self = shared_from_this(), found](const Expected<SharedBytes>& file) {
    self->send_map(found, file);
  });
}

void HttpSession::upgrade() {
  const HttpRequest& request = parser_->get();
  switch (judge(host_.rules, credentials_of(request))) {
    case Verdict::kAllowed:
      break;
    case Verdict::kWrongToken:
      return send({401, {}, {}});
    case Verdict::kWrongHost:
    case Verdict::kWrongOrigin:
      return send({403, {}, {}});
  }
  // No client speaks before it has been let in.
  if (inbox_.size() > 0) return send({400, {}, {}});
  if (!host_.has_room()) return send({503, {{"Retry-After", "5"}}, {}});
  auto chosen = host_.choose(view(request[http::field::sec_websocket_protocol]));
  if (!chosen) return send({400, {}, {}});
  auto session = std::make_shared<SocketSession>(std::move(stream_), std::move(chosen->viewer),
                                                 chosen->limits);
  session->accept(request, chosen->subprotocol,
                  [&host = host_, alive = alive_](std::shared_ptr<SocketSession> opened) {
                    host.opened(std::move(opened));
                  });
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
  const std::string text = file.error().text() + "\n";
  answer.status = file.error().code == ErrorCode::kNotFound ? 404 : 500;
  std::erase_if(answer.headers, [](const auto& header) {
    return header.first == "Content-Disposition" || header.first == "Content-Type";
  });
  answer.headers.emplace_back("Content-Type", "text/plain; charset=utf-8");
  const auto bytes = std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end());
  answer.body = *bytes;
  send(answer, bytes);
}

void HttpSession::send(const HttpAnswer& answer, SharedBytes body) {
  const HttpRequest& request = parser_->get();
  auto sending = std::make_shared<Sending>();
  auto& response = sending->response;
  response.result(static_cast<http::status>(answer.status));
  response.version(request.version());
  for (const auto& [name, value] : answer.headers) response.set(name, value);
  if (request.method() != http::verb::head) {
    response.body() = {answer.body.data(), answer.body.size()};
  }
  response.content_length(answer.body.size());
  sending->body = std::move(body);
  sending->goes_on = answer.status == 200 && request.keep_alive();
  response.keep_alive(sending->goes_on);
  write_on(sending);
}

/// Piece by piece: over a slow link the whole takes long, and only a client that takes nothing at
/// all is given up.
void HttpSession::write_on(const std::shared_ptr<Sending>& sending) {
  stream_.expires_after(kStall);
  http::async_write_some(
      stream_, sending->serializer,
      [self = shared_from_this(), sending](beast::error_code error, std::size_t) {
        if (error) return;
        if (!sending->serializer.is_done()) return self->write_on(sending);
        if (sending->goes_on) return self->read();
        beast::error_code ignored;
        self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
      });
}

}  // namespace swiftlet::station
