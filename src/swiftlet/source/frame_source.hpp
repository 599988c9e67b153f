// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/trusted_poses.hpp"
#include "swiftlet/source/intrinsics_note.hpp"
#include "swiftlet/source/rig/stamp_judge.hpp"
#include "swiftlet/source/rig_event.hpp"
#include "swiftlet/source/rig_statistics.hpp"

namespace swiftlet {

class LiveSink;
struct RigOptions;

/// Why a source could not turn a depth image into a Frame.
enum class FrameLoss : std::uint8_t {
  kNoPose,         ///< no pose brackets its time: before the first, after the last, or none at all
  kPoseGap,        ///< the bracketing poses lie too far apart to interpolate between
  kPoseRefused,    ///< its pose is not finite, not unit, or not trusted by the tracker
  kOutOfOrder,     ///< its time is not after that of the image before it
  kPoseJump,       ///< the pose source has jumped at its time
  kPoseStale,      ///< the tracker had been silent for too long
  kClockMismatch,  ///< stamped by another clock than the poses
  kOverload,       ///< it came while the mapper was busy with others (real time only)
  kImageMissing,   ///< the recording names it, but its file is not there
  kImageUnreadable,  ///< its file is damaged, of another kind, or of another size than the first
  kBadStamp,         ///< its time agrees neither with the images before it nor with those after
};
/// For people and machines, by FrameLoss.
inline constexpr std::array<std::string_view, 11> kFrameLossNames{
    "no_pose",        "pose_gap", "pose_refused",  "out_of_order",     "pose_jump", "pose_stale",
    "clock_mismatch", "overload", "image_missing", "image_unreadable", "bad_stamp"};

/// Frames that came out of a source, and those that did not, by reason.
struct FrameTally {
  std::size_t delivered = 0;  ///< frames that came out
  /// Frames that did not, by FrameLoss.
  std::array<std::size_t, kFrameLossNames.size()> lost{};
  std::size_t poses_refused = 0;  ///< pose samples (not frames) that were refused
  /// Poses that were refused, by the reason.
  std::array<std::size_t, kPoseRefusalNames.size()> poses_refused_by{};
  std::size_t pose_jumps = 0;    ///< times the pose source corrected itself at once
  std::size_t stale_alarms = 0;  ///< times the tracker fell silent while images came
  RigEventCounts events{};       ///< of instruments
  ClockSteps pose_clock{};       ///< times the clock of the poses was set
  ClockSteps image_clock{};      ///< likewise, of the camera where it was most often

  /// Frames that were lost for a reason.
  std::size_t& of(FrameLoss loss) { return lost[static_cast<std::size_t>(loss)]; }
};

/// What a source knows of itself before its first frame.
struct SourceInfo {
  std::string uri;             ///< as the user typed it
  std::string native_up_axis;  ///< the world axis of the recording that points up, as in "-y"
  std::optional<std::size_t> frame_count;  ///< for progress bars; absent where only the end tells
  std::optional<double>
      baseline_m;               ///< of the stereo pair (or projector and camera), where it is known
  IntrinsicsNote intrinsics{};  ///< where those of its cameras came from
  /// The unit of depth [m] if nobody told it and the source took that of its layout.
  std::optional<double> assumed_depth_unit_m{};
  std::vector<std::string> choices{};  ///< what was chosen of a recording, one sentence each
};

/// Where frames come from. Poses are in our world (z up), whatever the recording's own axes.
/// Thread safety: none, one owner.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, later than every one before, or of the same time by a camera of a higher
  /// number; nullopt at the end. Frames without a trustworthy pose are skipped and counted. Errors:
  /// kCorruptInput, kIo, with file and line; the source is then at its end.
  [[nodiscard]] virtual Expected<std::optional<Frame>> next() = 0;

  /// What is known before the first frame.
  [[nodiscard]] virtual const SourceInfo& info() const = 0;
  /// What was lost so far.
  [[nodiscard]] virtual const FrameTally& tally() const = 0;

  /// What has come from the instruments, used or not, and how they are mounted; null for sources
  /// that are no rig. Both stay where they are; next() changes the facts.
  [[nodiscard]] virtual const RigStatistics* statistics() const { return nullptr; }
  /// The cameras and mounts that it joins; null if it is no rig.
  [[nodiscard]] virtual const RigOptions* rig() const { return nullptr; }

  /// Where poses come to that others than the source receive; null: it has its own.
  [[nodiscard]] virtual LiveSink* pose_sink() { return nullptr; }

  /// A source asks this while it has no frame to hand out: a live one ten times a second, others
  /// while they skip what has no pose. tally() may be read then. After a true next() ends.
  virtual void stop_when(const std::function<bool()>& /*is_unwanted*/) {}
  /// What has happened to live instruments, and which records were skipped, since the last call.
  [[nodiscard]] virtual std::vector<RigEvent> take_events() { return {}; }
};

/// Every source is handed out so.
using FrameSourcePtr = std::unique_ptr<FrameSource>;

}  // namespace swiftlet
