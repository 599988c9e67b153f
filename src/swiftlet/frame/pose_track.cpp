// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/frame/pose_track.hpp"

#include <algorithm>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

PoseTrack::PoseTrack(const Options& options) : options_(options) {
  SWIFTLET_REQUIRE(options.capacity >= 2, "interpolation needs room for two poses");
}

PoseIntake PoseTrack::push(Stamp stamp, const Eigen::Quaterniond& R_world_body,
                           const Eigen::Vector3d& t_world_body_m, PoseMark mark) {
  const PoseIntake intake = [&] {
    if (!R_world_body.coeffs().allFinite() || !t_world_body_m.allFinite())
      return PoseIntake::kNotFinite;
    const auto T_world_body = Transform<World, Body>::from(R_world_body, t_world_body_m);
    return T_world_body ? insert(stamp, {*T_world_body, mark}) : PoseIntake::kNotUnit;
  }();
  ++counts_[static_cast<std::size_t>(intake)];
  return intake;
}

PoseIntake PoseTrack::insert(Stamp stamp, const TrackedPose& pose) {
  const bool is_full = poses_.size() == options_.capacity;
  if (is_full && stamp < poses_.front().stamp) return PoseIntake::kTooOld;

  const auto place = std::ranges::lower_bound(poses_, stamp, {}, &Pose::stamp);
  if (place != poses_.end() && place->stamp == stamp) return PoseIntake::kDuplicateStamp;
  poses_.insert(place, Pose{stamp, pose});
  if (is_full) poses_.pop_front();
  return PoseIntake::kAdded;
}

tl::expected<PoseTrack::Bracket, PoseMiss> PoseTrack::bracket(Stamp stamp) const {
  if (poses_.empty()) return tl::make_unexpected(PoseMiss::kEmpty);
  if (stamp < poses_.front().stamp) return tl::make_unexpected(PoseMiss::kBeforeFirst);
  if (stamp > poses_.back().stamp) return tl::make_unexpected(PoseMiss::kAfterLast);

  const auto after = std::ranges::lower_bound(poses_, stamp, {}, &Pose::stamp);
  if (after->stamp == stamp) return Bracket{&*after, &*after};
  const auto before = std::prev(after);
  if (before->pose.mark.segment != after->pose.mark.segment)
    return tl::make_unexpected(PoseMiss::kAcrossJump);
  if (after->stamp - before->stamp > options_.max_gap)
    return tl::make_unexpected(PoseMiss::kGapTooLong);
  return Bracket{&*before, &*after};
}

tl::expected<TrackedPose, PoseMiss> PoseTrack::find(Stamp stamp) const {
  const auto found = bracket(stamp);
  if (!found) return tl::make_unexpected(found.error());
  const auto& [before, after] = *found;
  if (before == after) return after->pose;

  const double s = seconds(stamp - before->stamp) / seconds(after->stamp - before->stamp);
  const Transform<World, Body>& T0 = before->pose.T_world_body;
  const Transform<World, Body>& T1 = after->pose.T_world_body;
  return TrackedPose{
      Transform<World, Body>::trusted(T0.rotation().slerp(s, T1.rotation()).normalized(),
                                      T0.translation() + s * (T1.translation() - T0.translation())),
      before->pose.mark};
}

tl::expected<TrackedPose, PoseMiss> PoseTrack::nearest(Stamp stamp) const {
  const auto found = bracket(stamp);
  if (!found) return tl::make_unexpected(found.error());
  const auto& [before, after] = *found;
  return stamp - before->stamp <= after->stamp - stamp ? before->pose : after->pose;
}

tl::expected<Transform<World, Body>, PoseMiss> PoseTrack::at(Stamp stamp) const {
  return find(stamp).map([](const TrackedPose& pose) { return pose.T_world_body; });
}

}  // namespace swiftlet
