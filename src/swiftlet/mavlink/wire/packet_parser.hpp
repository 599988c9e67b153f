// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "swiftlet/base/time.hpp"
#include "swiftlet/mavlink/wire/packet.hpp"
#include "swiftlet/mavlink/wire/signature_guard.hpp"

namespace swiftlet::mavlink {

/// Finds frames in a stream of bytes. What is no frame, is harmed, or must not be believed is
/// counted and left out; after it the search goes on one byte further, so that a broken frame never
/// hides a sound one. A frame of a message that is not spoken here cannot be checked: where a frame
/// is due, behind another one, it is stepped over unread, as its bytes are data and not searched
/// for others; elsewhere it is taken for none. Thread safety: none, one owner. Cost: does not
/// allocate without a guard.
class PacketParser {
 public:
  /// With a guard, only what it admits passes. One guard may serve the parsers of several links of
  /// one thread; it must outlive them.
  explicit PacketParser(SignatureGuard* guard = nullptr) : guard_(guard) {}

  /// Takes the next bytes of the stream; calls visit(const Packet&) for each packet that they
  /// complete. `now`: Unix time, for the guard.
  template <class Visit>
  void feed(std::span<const std::uint8_t> bytes, Stamp now, Visit&& visit) {
    while (!bytes.empty()) {
      bytes = bytes.subspan(take(bytes));
      while (const auto packet = next(now)) visit(*packet);
    }
  }
  /// Forgets the beginning of a frame: the next bytes belong to another datagram or connection.
  void start_anew() {
    begin_ = end_ = 0;
    is_in_step_ = true;
  }

  struct Tally {
    std::size_t packets = 0;
    std::size_t bad_checksums = 0;
    std::size_t unknown_messages = 0;
    std::size_t unknown_flags = 0;  ///< frames with a flag that must be understood and is not
    std::size_t unsigned_packets = 0, forged = 0, replayed = 0;
    std::size_t skipped_bytes = 0;  ///< that belong to no frame
  };
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  std::size_t take(std::span<const std::uint8_t> bytes);
  [[nodiscard]] std::optional<Packet> next(Stamp now);
  [[nodiscard]] std::optional<Packet> judge(std::span<const std::uint8_t> frame, Stamp now);
  [[nodiscard]] bool is_admitted(std::span<const std::uint8_t> frame, Stamp now);
  [[nodiscard]] std::span<const std::uint8_t> waiting() const {
    return std::span(bytes_).subspan(begin_, end_ - begin_);
  }
  void skip_to_start();
  void skip_start() {
    ++tally_.skipped_bytes;
    ++begin_;
    is_in_step_ = false;
  }

  SignatureGuard* guard_;
  std::array<std::uint8_t, 2 * wire::kMaxFrameBytes> bytes_{};
  std::size_t begin_ = 0, end_ = 0;  // of what waits in bytes_
  bool is_in_step_ = true;           // a frame is due at begin_
  Tally tally_;
};

}  // namespace swiftlet::mavlink
