// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_set>
#include <vector>

#include "swiftlet/station/state/map_mirror.hpp"

namespace swiftlet::station {

/// What one client lacks of the map: a set of blocks, never a queue of old states of them. A slow
/// client therefore gets fewer updates and never an older map, and what it costs is bounded.
///
/// Thread safety: the station's thread alone.
class ClientQueue {
 public:
  static constexpr std::size_t kPacketsRemembered = 256;  ///< that a client may ask for again
  static constexpr std::size_t kMaxBlocksPerPacket = 64;

  /// Blocks of one packet. A packet that says so makes the client drop what it has.
  struct Batch {
    std::vector<BlockIndex> blocks;
    bool clears_first = false;
  };

  /// Everything is to be sent, as to a client that has just come.
  void start_again(const MapMirror& mirror);
  /// These blocks have changed or gone. So many of them that starting again is cheaper do that.
  void mark(const std::vector<BlockIndex>& changed, const MapMirror& mirror);

  /// The blocks of the next packet, those nearest to `centre` first; empty if the client is up to
  /// date. They stand in one packet together: at most 32767 blocks apart along each axis.
  [[nodiscard]] Batch next(const BlockIndex& centre, std::size_t max_blocks = kMaxBlocksPerPacket);
  /// Remembers what went out under which number.
  void sent(std::uint32_t sequence, Batch&& batch);
  /// The client has missed the packets [first, last]: sends their blocks again, as they are now, or
  /// everything if that is too long ago.
  void resend(std::uint32_t first, std::uint32_t last, const MapMirror& mirror);

  [[nodiscard]] std::size_t pending() const { return dirty_.size(); }
  [[nodiscard]] bool is_up_to_date() const { return dirty_.empty() && !clears_next_; }

 private:
  struct Sent {
    std::uint32_t sequence;
    Batch batch;
  };
  void order_nearest(const BlockIndex& centre);

  std::unordered_set<BlockIndex, BlockHash> dirty_;
  std::vector<BlockIndex> order_;  // the nearest dirty blocks, farthest first
  bool clears_next_ = false;
  std::deque<Sent> ledger_;  // packets with blocks, oldest first
};

}  // namespace swiftlet::station
