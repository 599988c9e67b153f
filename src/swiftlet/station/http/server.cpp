// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <thread>

#include "swiftlet/base/start_thread.hpp"
#include "swiftlet/station/http/http_session_private.hpp"
#include "swiftlet/station/http/server_private.hpp"

namespace swiftlet::station {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Picks from "a, b" what this server speaks; a client that offers nothing gets nothing.
std::optional<HttpHost::Chosen> choose_protocol(std::string_view offered, const MapModel& model) {
  while (!offered.empty()) {
    const auto end = std::min(offered.find(','), offered.size());
    std::string_view name = offered.substr(0, end);
    offered.remove_prefix(std::min(end + 1, offered.size()));
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    for (const Subprotocol& known : subprotocols()) {
      if (known.name == name) {
        return HttpHost::Chosen{
            [&model, make = known.make] { return make(model); },
            std::string(name),
            {.max_message = known.max_message, .messages_per_s = known.messages_per_s}};
      }
    }
  }
  return std::nullopt;
}

class Server final : public Station {
 public:
  Server(const StationOptions& options, MapModel model)
      : Station(options.access.token),
        options_(options),
        model_(std::move(model)),
        door_(options_.access, options_.tell, Clock::now()),
        waiting_(options_.max_waiting),
        answers_(options_.max_connections),
        downloads_(options_.max_downloads),
        sockets_(options_.max_clients),
        host_{options_.access,
              door_,
              waiting_,
              answers_,
              downloads_,
              sockets_,
              options_.timeout,
              [this](std::string_view offered) { return choose_protocol(offered, model_); },
              [this](auto session) { clients_.push_back(std::move(session)); },
              [this](auto ready) { download_.ask(Clock::now(), std::move(ready)); }} {}

  ~Server() override {
    io_.stop();
    if (thread_.joinable()) thread_.join();
  }

  Status listen() {
    boost::system::error_code error;
    const tcp::endpoint place(asio::ip::make_address(options_.listen.host), options_.listen.port);
    const auto refused = [&](std::string remedy) {
      return fail(ErrorCode::kIo, options_.listen.text(),
                  fmt::format("cannot listen there: {}", error.message()), std::move(remedy));
    };
    acceptor_.open(place.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(place, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      return refused("choose another address with --listen, or port 0 for any that is free");
    options_.listen.port = acceptor_.local_endpoint(error).port();
    accept();
    tick();
    auto thread = start_thread("ground station", [this] {
      run_with_low_priority();
      io_.run();
    });
    if (!thread) return forward_error(std::move(thread));
    thread_ = std::move(*thread);
    return Done{};
  }

  const ListenAddress& address() const override { return options_.listen; }

 private:
  using Clock = std::chrono::steady_clock;

  void accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();
      std::make_shared<HttpSession>(std::move(socket), host_)->read(options_.timeout);
      if (waiting_.sent_away() > sent_away_) {
        sent_away_ = waiting_.sent_away();
        door_.note("a connection", "more wait and ask nothing than there is room for",
                   Clock::now());
      }
      accept();
    });
  }

  /// The system has run out of descriptors or memory: asked again at once, it would say so again,
  /// and this thread would do nothing else.
  void accept_later() {
    constexpr std::chrono::milliseconds kPause{100};
    waiting_.send_one_away();
    pause_.expires_after(kPause);
    pause_.async_wait([this](boost::system::error_code error) {
      if (!error) accept();
    });
  }

  void tick() {
    timer_.expires_after(options_.tick);
    timer_.async_wait([this](boost::system::error_code error) {
      if (error) return;
      poll();
      tick();
    });
  }

  void poll() {
    std::erase_if(clients_, [](const auto& client) { return !client->is_open(); });
    const MapModel::Update update = model_.poll();
    const auto now = Clock::now();
    download_.tidy(now);
    const auto shows_depth = [](const auto& client) { return client->protocol().wants_depth(); };
    if (std::ranges::any_of(clients_, shows_depth)) model_.ask_for_depth();
    for (const auto& client : clients_) {
      client->protocol().saw(update);
      client->protocol().count(static_cast<std::uint32_t>(clients_.size()));
      client->check(now);
      client->pump();
    }
  }

  StationOptions options_;
  MapModel model_;
  Door door_;
  WaitingRoom waiting_;
  std::size_t sent_away_ = 0;
  Places answers_;
  Places downloads_;
  Places sockets_;
  HttpHost host_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_{io_};
  asio::steady_timer timer_{io_};
  asio::steady_timer pause_{io_};
  std::vector<std::shared_ptr<SocketSession>> clients_;
  MapDownload download_{io_, model_, options_.save_map, options_.max_download_bytes};
  std::thread thread_;
};

}  // namespace

Expected<std::unique_ptr<Station>> start_server(const StationOptions& options, MapModel model) {
  auto server = std::make_unique<Server>(options, std::move(model));
  if (auto listening = server->listen(); !listening) return forward_error(std::move(listening));
  return server;
}

}  // namespace swiftlet::station
