// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/mavlink/companion/latest_value.hpp"

namespace swiftlet::mavlink {

/// What the mapping thread tells of a frame that it has fused into the map.
struct MappedFrame {
  Transform<World, Body> T_world_body;
  HostTime taken_at{};           ///< the middle of its exposure, on this computer's clock
  HostTime mapped_at{};          ///< when the map with it was published
  std::uint32_t pose_epoch = 0;  ///< as Frame::pose_epoch
  std::uint8_t confidence = 3;   ///< of the pose: 0 failed, 1 low, 2 medium, 3 high
};

/// How urgent a sentence is for the pilot; the values are MAV_SEVERITY's.
enum class Urgency : std::uint8_t { kCritical = 2, kWarning = 4, kInfo = 6 };

/// What a flight tells whoever speaks to the autopilot. Thread safety: map_begun() and mapped()
/// from the mapping thread, tell_pilot() from any, the others from the links' thread. Real time:
/// mapped() neither waits nor allocates; map_begun() takes a lock that is otherwise held for a
/// move.
class FlightNews {
 public:
  /// A new map begins, which has nothing of the one before.
  void map_begun(MapReader reader);
  void mapped(const MappedFrame& frame) { frames_.put(frame); }
  /// A sentence for the pilot, of which 50 characters arrive. The newest few are kept.
  void tell_pilot(Urgency urgency, std::string_view text);

  struct Sentence {
    Urgency urgency;
    std::string text;
  };
  [[nodiscard]] std::optional<MapReader> take_map();
  [[nodiscard]] std::optional<MappedFrame> take_frame() { return frames_.take(); }
  [[nodiscard]] std::vector<Sentence> take_sentences();

 private:
  static constexpr std::size_t kMostSentences = 8;

  LatestValue<MappedFrame> frames_;
  std::mutex mutex_;
  std::optional<MapReader> begun_;   // guarded by mutex_
  std::vector<Sentence> sentences_;  // guarded by mutex_
};

}  // namespace swiftlet::mavlink
