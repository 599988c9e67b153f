// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// What became of a pose that was offered to a PoseTrack.
enum class PoseIntake : std::uint8_t {
  kAdded,           ///< in order, or sorted into its place
  kDuplicateStamp,  ///< the track has a pose of that time; the first one stays
  kTooOld,          ///< before everything a full track remembers
  kNotFinite,       ///< NaN or infinity
  kNotUnit,         ///< the quaternion is not of unit length
};
/// How many kinds of PoseIntake there are.
inline constexpr std::size_t kPoseIntakeKinds = 5;

/// Why a track has no pose for a time.
enum class PoseMiss : std::uint8_t {
  kEmpty,        ///< no pose has come yet
  kBeforeFirst,  ///< the time lies before the oldest pose that is remembered
  kAfterLast,    ///< the pose has not come yet; the track never extrapolates
  kGapTooLong,   ///< the bracketing poses lie further apart than max_gap
  kAcrossJump,   ///< the pose source has jumped between the bracketing poses
};

/// Where a pose stands in the history of its source. Poses of different segments are never
/// interpolated; those of different epochs do not share a world (see Frame::pose_epoch).
struct PoseMark {
  std::uint32_t segment = 0;  ///< between two of them nothing is interpolated
  std::uint32_t epoch = 0;    ///< of the world that the poses are in
};

/// What a track answers.
struct TrackedPose {
  Transform<World, Body> T_world_body;  ///< where the vehicle was
  PoseMark mark;                        ///< which stretch of the track it belongs to
};

/// The recent path of the body: interpolates its pose at any time between two poses that it has
/// received.
///
/// Interpolation is linear in the position and spherical (SLERP) in the rotation.
/// Memory: at most `capacity` poses; the oldest goes first. Thread safety: none, one owner.
class PoseTrack {
 public:
  /// What poses are taken, and how far apart they may be.
  struct Options {
    std::size_t capacity = 4096;                           ///< 20 s of a T265 at 200 Hz
    Nanoseconds max_gap = std::chrono::milliseconds(200);  ///< longest bridge between two poses
  };

  PoseTrack() : PoseTrack(Options{}) {}
  /// Empty.
  explicit PoseTrack(const Options& options);

  /// Offers one raw pose; refused ones are counted. Cost: O(1) in order, O(capacity) out of order.
  PoseIntake push(Stamp stamp, const Eigen::Quaterniond& R_world_body,
                  const Eigen::Vector3d& t_world_body_m, PoseMark mark = {});

  /// Pose of the body at a time. Never extrapolates.
  [[nodiscard]] tl::expected<Transform<World, Body>, PoseMiss> at(Stamp stamp) const;
  /// The same, with its place in the history.
  [[nodiscard]] tl::expected<TrackedPose, PoseMiss> find(Stamp stamp) const;
  /// The nearer of the two poses that bracket a time, as it is: only to show what interpolation is
  /// worth. Misses like find().
  [[nodiscard]] tl::expected<TrackedPose, PoseMiss> nearest(Stamp stamp) const;

  /// Poses kept.
  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  /// Poses of each kind that were pushed so far.
  [[nodiscard]] std::size_t count(PoseIntake kind) const {
    return counts_[static_cast<std::size_t>(kind)];
  }

  /// Forgets the poses, not the counts.
  void clear() { poses_.clear(); }

 private:
  struct Pose {
    Stamp stamp;
    TrackedPose pose;
  };
  using Bracket = std::pair<const Pose*, const Pose*>;  // twice the same at a pose itself
  PoseIntake insert(Stamp stamp, const TrackedPose& pose);
  [[nodiscard]] tl::expected<Bracket, PoseMiss> bracket(Stamp stamp) const;

  Options options_;
  std::deque<Pose> poses_;  // ascending stamps, all different
  std::array<std::size_t, kPoseIntakeKinds> counts_{};
};

}  // namespace swiftlet
