// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/plan/course.hpp"
#include "swiftlet/station/page/client_queue.hpp"
#include "swiftlet/station/state/map_info.hpp"
#include "swiftlet/station/state/map_mirror.hpp"

struct ZSTD_CCtx_s;

namespace swiftlet::station {

/// The subprotocol of docs/formats/station_wire.md, version 1.
inline constexpr std::string_view kSubprotocol = "swiftlet.v1";
inline constexpr std::uint8_t kWireVersion = 1;

using Bytes = std::vector<std::uint8_t>;

/// The values are on the wire.
enum class MessageType : std::uint8_t {
  kBlocks = 1,
  kFrames = 2,
  kStatus = 3,
  kChecksum = 4,
  kCourse = 5
};

/// What every binary message begins with.
struct MessageHeader {
  std::uint32_t sequence = 0;  ///< of this client, one more each message
  std::uint32_t world = 0;     ///< a new number: the map was begun anew
};

/// Whether the map still grows. The values are on the wire.
enum class FlightState : std::uint8_t { kWaiting = 0, kFlying = 1, kOver = 2, kSaved = 3 };

/// Where things stand, for one client.
struct StatusReport {
  FlightState state = FlightState::kWaiting;
  BlockWindow window{};
  Eigen::Vector3d trigger_centre_m = Eigen::Vector3d::Zero();  ///< [world]
  std::uint64_t frame_count = 0;
  std::uint64_t memory_bytes = 0;
  std::uint32_t blocks = 0;
  std::uint32_t pending = 0;  ///< blocks that this client still lacks
  std::uint32_t clients = 0;
  std::uint32_t rate_limit = 0;         ///< of this client [bytes/s]; 0 is none
  std::uint32_t reports_missed = 0;     ///< frames that the station did not hear of
  std::vector<std::uint32_t> verdicts;  ///< frames so far, by MapInfo::verdicts
  std::vector<std::uint32_t> losses;    ///< frames so far, by MapInfo::losses
};

/// The first message, a text: JSON with what MapInfo tells.
[[nodiscard]] std::string hello_text(const MapInfo& info, std::uint32_t world);
[[nodiscard]] Bytes frames_message(const MessageHeader& header,
                                   std::span<const FrameReport> reports);
[[nodiscard]] Bytes status_message(const MessageHeader& header, const StatusReport& status);
/// Of a path or a frontier with more than 4096 parts, the first ones.
[[nodiscard]] Bytes course_message(const MessageHeader& header, const Course& course);
/// The client has been sent all of the map as of this frame; its digest must be this.
[[nodiscard]] Bytes checksum_message(const MessageHeader& header, std::uint64_t frame_count,
                                     const MapDigest& digest);

/// Blocks, packed so that each message can be read without any other.
/// Thread safety: one thread at a time.
class BlockPacker {
 public:
  BlockPacker();
  /// The blocks of the batch as the mirror holds them now; those it does not hold are said to be
  /// gone. REQUIRES: the batch comes from ClientQueue::next().
  [[nodiscard]] Bytes blocks_message(const MessageHeader& header, const ClientQueue::Batch& batch,
                                     const MapMirror& mirror);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> compressor_;
  Bytes plain_;
  Bytes packed_;
};

}  // namespace swiftlet::station
