// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/mavlink/links/link_address.hpp"
#include "swiftlet/mavlink/wire/packet_parser.hpp"
#include "swiftlet/mavlink/wire/packet_writer.hpp"
#include "swiftlet/mavlink/wire/signer.hpp"

namespace swiftlet::mavlink {

struct LinkOptions {
  std::vector<LinkAddress> links;
  std::optional<SigningKey> key{};  ///< then only what is signed with it is heard
  /// Also listen where anybody may speak, without a key.
  bool hears_anyone = false;
  std::chrono::milliseconds tick{5};
  std::chrono::milliseconds retry{1000};         ///< between two attempts to open a link
  std::chrono::milliseconds peer_silence{3000};  ///< after which another may become the peer
};

/// What has come and gone on one link.
struct LinkTally {
  PacketParser::Tally in{};
  std::size_t sent = 0;
  std::size_t unsent = 0;     ///< frames that a full or closed link did not take
  std::size_t strangers = 0;  ///< datagrams of others than the peer, not read
  std::size_t openings = 0;   ///< 2 and more: it was opened again
};

/// Where frames go to be sent.
class FrameOutlet {
 public:
  virtual ~FrameOutlet() = default;
  /// Never waits. REQUIRES: link < the number of links.
  virtual void send(std::size_t link, const WireFrame& frame) = 0;
};

/// Who speaks over links. All is called by their thread; what it sends it gives to `out` before it
/// returns.
class LinkUser {
 public:
  virtual ~LinkUser() = default;
  virtual void received(std::size_t link, const Packet& packet, FrameOutlet& out) = 0;
  /// A link was opened, or could not be, or is gone; told once a change.
  virtual void link_changed(std::size_t link, bool is_open, const std::string& what) = 0;
  /// Called every LinkOptions::tick.
  virtual void tick(FrameOutlet& out) = 0;
};

/// The links to autopilots: sockets and serial lines, in one thread of low priority. What cannot be
/// opened, or breaks, is tried again. Nobody waits: what a link does not take at once and has no
/// room for is dropped and counted.
class LinkThread {
 public:
  /// `user` must outlive it; it is called from before start() returns until the destructor has.
  /// Errors: kUsage for no link, or one on which anybody could speak (see
  /// LinkAddress::has_known_peer()) without a key or hears_anyone; kIo for a UDP port that cannot
  /// be had; kUnsupported in a build without links.
  [[nodiscard]] static Expected<std::unique_ptr<LinkThread>> start(const LinkOptions& options,
                                                                   LinkUser& user);
  virtual ~LinkThread() = default;

  /// As of the last tick. Thread safety: any thread.
  [[nodiscard]] virtual LinkTally tally(std::size_t link) const = 0;
};

}  // namespace swiftlet::mavlink
