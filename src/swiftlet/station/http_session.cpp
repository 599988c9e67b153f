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
  const HttpQuestion question{view(request.method_string()), credentials_of(request)};
  send(answer(host_.rules, question, page_files()));
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

void HttpSession::send(const HttpAnswer& answer) {
  using Response = http::response<http::span_body<const std::uint8_t>>;
  const HttpRequest& request = parser_->get();
  auto response =
      std::make_shared<Response>(static_cast<http::status>(answer.status), request.version());
  for (const auto& [name, value] : answer.headers) response->set(name, value);
  if (request.method() != http::verb::head) {
    response->body() = {answer.body.data(), answer.body.size()};
  }
  response->content_length(answer.body.size());
  const bool goes_on = answer.status == 200 && request.keep_alive();
  response->keep_alive(goes_on);
  sending_ = response;
  http::async_write(stream_, *response,
                    [self = shared_from_this(), goes_on](beast::error_code error, std::size_t) {
                      self->sending_.reset();
                      if (error) return;
                      if (goes_on) return self->read();
                      beast::error_code ignored;
                      self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send,
                                                      ignored);
                    });
}

}  // namespace swiftlet::station
