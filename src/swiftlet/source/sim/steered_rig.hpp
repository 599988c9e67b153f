// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/scene.hpp"
#include "swiftlet/sim/stereo_camera.hpp"
#include "swiftlet/sim/tracker/pose_delivery.hpp"
#include "swiftlet/sim/tracker/tracker_model.hpp"
#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/rig_file.hpp"

namespace swiftlet {

/// How the rig of a steered vehicle is built.
struct SteeredRigOptions {
  std::uint64_t seed = 1;              ///< of all noise
  double rate_hz = 15.0;               ///< depth images a second
  bool has_noise = true;               ///< false: ideal instruments, trusted from the start
  std::optional<std::string> fault{};  ///< something goes wrong with the poses: sim/pose_faults.cpp
  Stamp fault_at{5'000'000'000};       ///< when, where that matters
  RigOptions rig = intel_t265_d435_rig().rig;      ///< its first camera gets the scene's mount
  unsigned threads = sim::StereoCamera::kThreads;  ///< that draw an image; changes no bit of it
};

/// A pose of the body and when it was measured.
struct BelievedPose {
  Stamp stamp;
  Transform<World, Body> T_world_body;
};

/// The simulated D435 and T265 on a vehicle that goes where it wants, instead of along a flight
/// that was written before. Depth images and poses get the faults of a SimSource's, and meet in the
/// same Rig: what comes out are Frames as a real rig would give them, in the scene's world up to
/// the tracker's noise and drift.
///
///     rig.move_to(vehicle.state().stamp, vehicle.state().T_world_body());   // every few ms
///     while (auto frame = rig.next()) mapper.integrate(*frame);
///
/// Clock: 0 is when the rig is switched on. Repeatable: same scene, seed and moves, same frames.
class SteeredRig {
 public:
  /// `start`: where the body is at time 0, when all instruments are switched on. Errors: those of
  /// sim::RayCaster, sim::StereoCamera and of an unknown fault.
  [[nodiscard]] static Expected<SteeredRig> create(const sim::Scene& scene,
                                                   const SteeredRigOptions& options,
                                                   const Transform<World, Body>& start);

  /// The vehicle has flown from where it was last, straight and turning evenly, to here. Whatever
  /// the instruments measured on the way is taken. Cost: that of the images due (some 10 ms each).
  /// REQUIRES: `now` is not before the last.
  void move_to(Stamp now, const Transform<World, Body>& T_world_body);

  /// The oldest frame that has come by now; nullopt if there is none. An image waits for the pose
  /// after it, 5 ms at most.
  [[nodiscard]] std::optional<Frame> next() { return rig_.pop(); }

  /// Where the vehicle believes to be: the newest pose that is trusted, in the world of the map;
  /// nullopt before there is one. What a planner takes for its own place.
  [[nodiscard]] const std::optional<BelievedPose>& believed() const { return believed_; }

  /// By how much that is wrong, from the tracker's drift, noise and faults: a place p of the map
  /// lies in truth at p - drift().offset_m, and a heading at yaw - drift().yaw_rad. There the
  /// vehicle goes that is steered by this tracker. [scene]
  [[nodiscard]] sim::TrackerDrift drift() const { return drift_; }

  [[nodiscard]] const FrameTally& tally() const { return rig_.tally(); }
  [[nodiscard]] const RigStatistics& statistics() const { return rig_.statistics(); }
  [[nodiscard]] const RigOptions& rig() const { return rig_.options(); }
  [[nodiscard]] const PinholeIntrinsics& intrinsics() const { return camera_.intrinsics(); }

 private:
  struct Move {
    Stamp stamp;
    Transform<World, Body> T_world_body;
    [[nodiscard]] Transform<World, Body> to(const Move& next, Stamp stamp) const;
  };
  SteeredRig(sim::RayCaster world, sim::StereoCamera camera, sim::TrackerModel tracker,
             sim::PoseDelivery delivery, const SteeredRigOptions& options,
             const Transform<World, Body>& start);
  [[nodiscard]] Stamp next_image() const;
  void take_image(const Transform<World, Body>& T_world_body);
  void sample(const Transform<World, Body>& T_world_body);
  void deliver(Stamp until);
  void believe(Stamp stamp);

  sim::RayCaster world_;
  sim::StereoCamera camera_;
  sim::TrackerModel tracker_;
  sim::PoseDelivery delivery_;
  Rig rig_;
  double rate_hz_;
  Move last_;
  std::uint64_t images_ = 0;
  std::deque<Move> truth_;  // at the samples of the tracker, as many as may be on their way
  std::optional<BelievedPose> believed_;
  sim::TrackerDrift drift_;
};

}  // namespace swiftlet
