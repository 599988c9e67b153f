// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>
#include <vector>

#include "swiftlet/frame/pose_sample.hpp"
#include "swiftlet/frame/pose_track.hpp"

namespace swiftlet {

/// Why a pose sample is not used.
enum class PoseRefusal : std::uint8_t {
  kNotFinite,       ///< NaN or infinity
  kNotUnit,         ///< the quaternion is not of unit length
  kLowConfidence,   ///< the tracker itself does not trust it
  kClockMismatch,   ///< of another clock than the poses before
  kOutlier,         ///< where the body cannot have been, and nothing after it was there either
  kDuplicateStamp,  ///< there is a pose of that time
  kTooOld,          ///< before everything that is remembered
  kBadStamp,        ///< its time agrees neither with the poses before it nor with those after
};
inline constexpr std::array<std::string_view, 8> kPoseRefusalNames{
    "not_finite", "not_unit",        "low_confidence", "clock_mismatch",
    "outlier",    "duplicate_stamp", "too_old",        "bad_stamp"};

/// What to do when a pose source has recognised a place and corrects itself at once.
enum class JumpPolicy : std::uint8_t {
  kKeep,   ///< the map stays: from now on the jump is taken out of every pose
  kClear,  ///< the jump is followed in a new epoch: the map starts again
};

/// Limits of what a pose source may claim. A jump is a step that no vehicle makes: farther from
/// where the last poses led than `max_acceleration_mps2` explains, or farther from the last pose
/// than `max_speed_mps` allows, or turned more than `max_turn_radps` allows.
struct PoseGates {
  std::uint8_t min_confidence = 1;
  double max_speed_mps = 10.0;  ///< infinite: no look at the motion at all
  double max_acceleration_mps2 = 30.0;
  double max_turn_radps = 10.0;
  double slack_m = 0.02;    ///< noise of a pose; smaller jumps pass
  double slack_rad = 0.05;  ///< likewise
  std::size_t confirm = 3;  ///< poses that must agree on a jump before it is believed
  JumpPolicy on_jump = JumpPolicy::kKeep;

  /// For recordings whose poses are the truth already (motion capture).
  [[nodiscard]] static PoseGates open();
};

/// A PoseTrack behind gates: only poses that a real vehicle can have had get in. After a jump of
/// the source nothing is interpolated across it.
///
/// A sample that does not fit is held back. If the next ones agree with it, the source has jumped;
/// if they agree with the path before it, it was an outlier. A jump after a silence longer than the
/// track's max_gap cannot be measured, so it starts a new epoch under either policy.
/// Memory: that of PoseTrack. Thread safety: none, one owner.
class TrustedPoses {
 public:
  struct Options {
    PoseTrack::Options track;
    PoseGates gates;
  };
  explicit TrustedPoses(const Options& options) : options_(options), track_(options.track) {}

  void push(const PoseSample& sample);
  /// The source was switched off and on: its next pose is of another world, wherever it seems to
  /// be.
  void start_anew();
  /// The clock of the source was set: its next pose, stamped `first`, is later than all before,
  /// whatever its stamp says. Nothing is remembered but where the body was; if it cannot have come
  /// from there, a new epoch begins.
  void restart_clock(Stamp first);
  /// How many samples were refused by their stamps alone, before they came here.
  void note_bad_stamps(std::size_t count) {
    refused_[static_cast<std::size_t>(PoseRefusal::kBadStamp)] = count;
  }

  /// See PoseTrack::find() and nearest().
  [[nodiscard]] const PoseTrack& track() const { return track_; }

  /// Of the newest sample that passed the first gates, held back or not.
  [[nodiscard]] std::optional<Stamp> newest() const { return newest_; }
  [[nodiscard]] ClockDomain clock() const { return clock_; }

  [[nodiscard]] const std::array<std::size_t, kPoseRefusalNames.size()>& refused() const {
    return refused_;
  }
  [[nodiscard]] std::size_t jumps() const { return mark_.segment - clock_restarts_; }

 private:
  struct Pose {
    Stamp stamp;
    Transform<World, Body> T;  // as the source gives it, or anchored, as the place of use tells
  };
  void refuse(PoseRefusal reason, std::size_t count = 1) {
    refused_[static_cast<std::size_t>(reason)] += count;
  }
  [[nodiscard]] std::optional<Transform<World, Body>> checked(const PoseSample& sample);
  [[nodiscard]] bool is_plausible_after(const std::deque<Pose>& path, const Pose& next) const;
  [[nodiscard]] Pose anchored(const Pose& raw) const;
  void push_late(const Pose& pose);
  void hold(const Pose& raw);
  void accept(const Pose& pose);
  void jump();
  [[nodiscard]] Transform<World, World> anchor_after_jump() const;

  Options options_;
  PoseTrack track_;
  std::deque<Pose> recent_;  // the end of the path, anchored: what velocity is taken from
  std::deque<Pose> held_;    // candidates after a possible jump, raw
  Transform<World, World> T_world_source_;  // takes the jumps out
  PoseMark mark_;
  std::uint32_t clock_restarts_ = 0;
  std::optional<Stamp> newest_;
  ClockDomain clock_ = ClockDomain::kUnspecified;
  bool has_clock_ = false;
  std::array<std::size_t, kPoseRefusalNames.size()> refused_{};
};

}  // namespace swiftlet
