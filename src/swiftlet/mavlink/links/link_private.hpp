// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "swiftlet/mavlink/links/link_thread.hpp"

namespace swiftlet::mavlink {

/// What a link needs of its thread.
struct LinkHost {
  boost::asio::io_context& io;
  const LinkOptions& options;
  SignatureGuard* guard;  ///< null: no key
  std::function<void(const Packet&)> received;
  std::function<void(bool is_open, const std::string& what)> changed;

  [[nodiscard]] static Stamp now() {
    return {Nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
  }
};

/// One way to an autopilot. All but the constructor is called by the links' thread; it is destroyed
/// after that has ended.
class Link {
 public:
  explicit Link(LinkHost host) : host_(std::move(host)), parser_(host_.guard) {}
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;
  virtual void start() = 0;
  virtual void send(std::span<const std::uint8_t> frame) = 0;
  [[nodiscard]] LinkTally tally() const {
    LinkTally tally = tally_;
    tally.in = parser_.tally();
    return tally;
  }

 protected:
  /// Tells of a change, once.
  void tell(bool is_open, const std::string& what) {
    if (is_told_ && is_open == is_open_ && (is_open || what == what_)) return;
    is_told_ = true;
    is_open_ = is_open;
    what_ = what;
    if (is_open) ++tally_.openings;
    host_.changed(is_open, what);
  }

  LinkHost host_;
  PacketParser parser_;
  LinkTally tally_;

 private:
  bool is_told_ = false, is_open_ = false;
  std::string what_;
};

/// Errors: kIo if the port cannot be had.
[[nodiscard]] Expected<std::unique_ptr<Link>> make_udp_link(const LinkAddress& address,
                                                            LinkHost host);
[[nodiscard]] std::unique_ptr<Link> make_tcp_link(const LinkAddress& address, LinkHost host);
[[nodiscard]] std::unique_ptr<Link> make_serial_link(const LinkAddress& address, LinkHost host);

}  // namespace swiftlet::mavlink
