// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim/steered_rig.hpp"

#if SWIFTLET_HAS_EMBREE

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/sim/tracker/pose_faults.hpp"
#include "swiftlet/source/rig/t265_axes.hpp"

namespace swiftlet {
namespace {

/// Sets what goes wrong with the poses, if anything is asked to.
Status apply_fault(const SteeredRigOptions& options, sim::TrackerOptions& tracker,
                   sim::PoseFaults& faults) {
  if (!options.fault) return Done{};
  auto fault = find_registered(sim::pose_faults(), *options.fault, "fault");
  if (!fault) return forward_error(std::move(fault));
  fault->make(options.fault_at, tracker, faults);
  return Done{};
}

/// The turn about the vertical in a rotation.
double heading_rad(const Eigen::Quaterniond& R) {
  const Eigen::Vector3d forward = R * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace

Expected<SteeredRig> SteeredRig::create(const sim::Scene& scene, const SteeredRigOptions& options,
                                        const Transform<World, Body>& start) {
  if (!(options.rate_hz >= 0.1 && options.rate_hz <= 1000.0))
    return fail(ErrorCode::kUsage, "rig", "the rate of images must be from 0.1 to 1000 a second");
  sim::StereoOptions instrument = scene.camera;
  sim::TrackerOptions poses = scene.tracker;
  if (!options.has_noise) sim::make_ideal(instrument, poses);
  sim::PoseFaults faults;
  if (auto applied = apply_fault(options, poses, faults); !applied)
    return forward_error(std::move(applied));
  auto world = sim::RayCaster::create(scene);
  if (!world) return forward_error(std::move(world));
  auto camera = sim::StereoCamera::create(instrument, options.seed, options.threads);
  if (!camera) return forward_error(std::move(camera));
  SteeredRigOptions mounted = options;
  mounted.rig.cameras.resize(1);
  mounted.rig.cameras[0].T_body_camera = scene.T_body_camera;
  mounted.rig.cameras[0].baseline_m = instrument.baseline_m;
  return SteeredRig(std::move(*world), std::move(*camera),
                    sim::TrackerModel(poses, options.seed, start),
                    sim::PoseDelivery(faults, options.seed), mounted, start);
}

SteeredRig::SteeredRig(sim::RayCaster world, sim::StereoCamera camera, sim::TrackerModel tracker,
                       sim::PoseDelivery delivery, const SteeredRigOptions& options,
                       const Transform<World, Body>& start)
    : world_(std::move(world)),
      camera_(std::move(camera)),
      tracker_(std::move(tracker)),
      delivery_(std::move(delivery)),
      rig_(options.rig),
      rate_hz_(options.rate_hz),
      last_{Stamp{}, start} {}

Stamp SteeredRig::next_image() const {
  return {std::llround(static_cast<double>(images_) * 1e9 / rate_hz_)};
}

/// Between the last move and this one.
Transform<World, Body> SteeredRig::Move::to(const Move& next, Stamp stamp) const {
  const Nanoseconds whole = next.stamp - this->stamp;
  if (whole <= Nanoseconds(0)) return next.T_world_body;
  const double share = seconds(stamp - this->stamp) / seconds(whole);
  const Eigen::Vector3d from_m = T_world_body.translation();
  return Transform<World, Body>::trusted(
      T_world_body.rotation().slerp(share, next.T_world_body.rotation()).normalized(),
      from_m + share * (next.T_world_body.translation() - from_m));
}

void SteeredRig::move_to(Stamp now, const Transform<World, Body>& T_world_body) {
  SWIFTLET_REQUIRE(now >= last_.stamp, "time does not go back");
  const Move here{now, T_world_body};
  while (true) {
    const Stamp due = std::min(tracker_.next_stamp(), next_image());
    if (due > now) break;
    deliver(due);
    const auto T_due = last_.to(here, due);
    tracker_.next_stamp() == due ? sample(T_due) : take_image(T_due);
  }
  last_ = here;
  deliver(now);
}

void SteeredRig::sample(const Transform<World, Body>& T_world_body) {
  constexpr std::size_t kMostOnTheWay = 200;
  const Stamp due = tracker_.next_stamp();
  truth_.push_back({due, T_world_body});
  if (truth_.size() > kMostOnTheWay) truth_.pop_front();
  const sim::RawTrackerPose pose = tracker_.sample(T_world_body);
  if (!delivery_.is_dead(due)) delivery_.send(pose);
}

void SteeredRig::take_image(const Transform<World, Body>& T_world_body) {
  const Stamp due = next_image();
  world_.move_to(Nanoseconds(due.ns));
  const auto T_world_camera = T_world_body * rig_.options().cameras[0].T_body_camera;
  rig_.push(
      DepthFrame{due, camera_.capture(world_, T_world_camera, images_), camera_.intrinsics()});
  ++images_;
}

/// Hands the rig the poses that have arrived.
void SteeredRig::deliver(Stamp until) {
  while (delivery_.next_arrival() && *delivery_.next_arrival() <= until) {
    const sim::RawTrackerPose raw = delivery_.take();
    PoseSample pose = from_t265(raw.stamp, raw.R_raw, raw.t_raw_m, raw.confidence);
    const auto& T_scene_tracker = tracker_.T_scene_tracker();
    pose.R_world_body = T_scene_tracker.rotation() * pose.R_world_body;
    pose.t_world_body_m = T_scene_tracker * pose.t_world_body_m;
    rig_.push(pose);
    believe(raw.stamp);
  }
}

/// Takes the pose of that time for the vehicle's own, if the rig trusts it.
void SteeredRig::believe(Stamp stamp) {
  const auto pose = rig_.pose_at(stamp);
  if (!pose || (believed_ && stamp < believed_->stamp)) return;
  believed_ = {stamp, pose->T_world_body};
  const auto after = std::ranges::upper_bound(truth_, stamp, {}, &Move::stamp);
  if (after == truth_.begin()) return;  // stamped before all that is remembered
  const Transform<World, Body>& truth = std::prev(after)->T_world_body;
  drift_.offset_m = pose->T_world_body.translation() - truth.translation();
  drift_.yaw_rad = heading_rad(pose->T_world_body.rotation() * truth.rotation().conjugate());
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_EMBREE
