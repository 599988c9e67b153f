// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/links/link_thread.hpp"

#include <sys/resource.h>
#include <unistd.h>

#if SWIFTLET_HAS_MAVLINK
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <mutex>
#include <thread>

#include "swiftlet/base/start_thread.hpp"
#include "swiftlet/mavlink/links/link_private.hpp"
#endif

namespace swiftlet::mavlink {
namespace {

Status check_links(const LinkOptions& options) {
  if (options.links.empty()) return fail(ErrorCode::kUsage, "--mavlink", "there is no link");
  for (const LinkAddress& link : options.links) {
    if (link.has_known_peer() || options.key || options.hears_anyone) continue;
    return fail(ErrorCode::kUsage, "--mavlink " + link.text(),
                "whoever reaches this port could speak as the autopilot",
                "name the one that may with ?peer=ADDRESS, or sign with --mavlink-key FILE");
  }
  return Done{};
}

#if SWIFTLET_HAS_MAVLINK
namespace asio = boost::asio;

void give_way_to_the_mapper() {
  constexpr int kNice = 5;
  // On Linux this means the calling thread.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice));
}

class AsioLinks final : public LinkThread, private FrameOutlet {
 public:
  AsioLinks(const LinkOptions& options, LinkUser& user) : options_(options), user_(user) {
    if (options_.key) guard_.emplace(*options_.key);
  }
  ~AsioLinks() override {
    io_.stop();
    if (thread_.joinable()) thread_.join();
  }

  Status open() {
    for (std::size_t i = 0; i < options_.links.size(); ++i) {
      auto link = make(options_.links[i], i);
      if (!link) return forward_error(std::move(link));
      links_.push_back(std::move(*link));
    }
    tallies_.resize(links_.size());
    return Done{};
  }

  Status run() {
    auto thread = start_thread("--mavlink", [this] {
      give_way_to_the_mapper();
      for (const auto& link : links_) link->start();
      tick();
      io_.run();
    });
    if (!thread) return forward_error(std::move(thread));
    thread_ = std::move(*thread);
    return Done{};
  }

  LinkTally tally(std::size_t link) const override {
    const std::scoped_lock lock(mutex_);
    return tallies_[link];
  }

 private:
  void send(std::size_t link, const WireFrame& frame) override {
    links_[link]->send(frame.bytes());
  }

  Expected<std::unique_ptr<Link>> make(const LinkAddress& address, std::size_t index) {
    LinkHost host{io_, options_, guard_ ? &*guard_ : nullptr,
                  [this, index](const Packet& packet) { user_.received(index, packet, *this); },
                  [this, index](bool is_open, const std::string& what) {
                    user_.link_changed(index, is_open, what);
                  }};
    switch (address.kind) {
      case LinkKind::kTcp:
        return make_tcp_link(address, std::move(host));
      case LinkKind::kSerial:
        return make_serial_link(address, std::move(host));
      default:
        return make_udp_link(address, std::move(host));
    }
  }

  void tick() {
    timer_.expires_after(options_.tick);
    timer_.async_wait([this](boost::system::error_code error) {
      if (error) return;
      user_.tick(*this);
      {
        const std::scoped_lock lock(mutex_);
        for (std::size_t i = 0; i < links_.size(); ++i) tallies_[i] = links_[i]->tally();
      }
      tick();
    });
  }

  const LinkOptions options_;
  LinkUser& user_;
  std::optional<SignatureGuard> guard_;
  asio::io_context io_{1};
  asio::steady_timer timer_{io_};
  std::vector<std::unique_ptr<Link>> links_;
  mutable std::mutex mutex_;
  std::vector<LinkTally> tallies_;  // guarded by mutex_
  std::thread thread_;
};
#endif

}  // namespace

Expected<std::unique_ptr<LinkThread>> LinkThread::start(const LinkOptions& options,
                                                        LinkUser& user) {
  if (auto fine = check_links(options); !fine) return forward_error(std::move(fine));
#if SWIFTLET_HAS_MAVLINK
  auto links = std::make_unique<AsioLinks>(options, user);
  if (auto open = links->open(); !open) return forward_error(std::move(open));
  if (auto running = links->run(); !running) return forward_error(std::move(running));
  return links;
#else
  (void)user;
  return fail(ErrorCode::kUnsupported, "--mavlink", "this build has no links to an autopilot",
              "configure with -DSWIFTLET_WITH_MAVLINK=ON");
#endif
}

}  // namespace swiftlet::mavlink
