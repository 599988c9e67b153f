// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swiftlet {

/// What happens to the instruments of a live rig or in a recording. The flight goes on.
enum class RigEventKind : std::uint8_t {
  kStarted,       ///< it has been found and started
  kUnplugged,     ///< it is gone
  kStalled,       ///< it is there but says nothing any more; it is started again
  kRestarted,     ///< it delivers again
  kNotStarted,    ///< it cannot be started, or is not there; tried again twice a second
  kSlowUsb,       ///< it is on a USB 2 port
  kBadPose,       ///< a pose from outside could not be read
  kForgedPose,    ///< a datagram with poses is not of our key
  kReplayedPose,  ///< a datagram with poses has come before, or much too late
  kOpenPort,      ///< poses are taken from whoever can reach a port
  kSkipped,       ///< a record of a recording is bad and was left out
};
inline constexpr std::array<std::string_view, 11> kRigEventNames{
    "started",  "unplugged",   "stalled",       "restarted", "not_started", "slow_usb",
    "bad_pose", "forged_pose", "replayed_pose", "open_port", "skipped"};
[[nodiscard]] constexpr std::string_view name_of(RigEventKind kind) {
  return kRigEventNames[static_cast<std::size_t>(kind)];
}

/// How often each has happened, by kind.
using RigEventCounts = std::array<std::size_t, kRigEventNames.size()>;

struct RigEvent {
  RigEventKind kind;
  std::string who;        ///< the instrument, as in "camera 'front'"
  std::string what;       ///< one sentence, what to do included; may be empty
  std::size_t count = 1;  ///< how often it has happened since it was last told
};

/// Events that wait to be taken; the first 100. Not thread safe.
class RigEventList {
 public:
  void add(RigEvent event) {
    if (waiting_.size() < kMost) waiting_.push_back(std::move(event));
  }
  [[nodiscard]] std::vector<RigEvent> take() { return std::exchange(waiting_, {}); }

 private:
  static constexpr std::size_t kMost = 100;
  std::vector<RigEvent> waiting_;
};

}  // namespace swiftlet
