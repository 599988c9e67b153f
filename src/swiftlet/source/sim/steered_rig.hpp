// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/sim/pose_delivery.hpp"
#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/scene.hpp"
#include "swiftlet/sim/stereo_camera.hpp"
#include "swiftlet/sim/tracker_model.hpp"
#include "swiftlet/source/rig/rig.hpp"

namespace swiftlet {

/// How the rig of a steered vehicle is built.
struct SteeredRigOptions {
  std::uint64_t seed = 1;              ///< of all noise
  double rate_hz = 15.0;               ///< depth images a second
  bool has_noise = true;               ///< false: ideal instruments, trusted from the start
  std::optional<std::string> fault{};  ///< something goes wrong with the poses: sim/pose_faults.cpp
  Stamp fault_at{5'000'000'000};       ///< when, where that matters
  RigOptions rig{};                    ///< its first camera gets the scene's mount
  unsigned threads = sim::StereoCamera::kThreads;  ///< that draw an image; changes no bit of it
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

  /// What the tracker said last that was not refused: where the vehicle believes to be, in the
  /// world of the map. nullopt before it is sure of itself.
  [[nodiscard]] const std::optional<PoseSample>& believed() const { return believed_; }

  /// What the tracker's drift and jumps have made of the world: a place p of the map lies in truth
  /// at p - drift().offset_m, and a heading at yaw - drift().yaw_rad. A vehicle that is steered by
  /// that tracker goes there.
  [[nodiscard]] sim::TrackerDrift drift() const;

  [[nodiscard]] const FrameTally& tally() const { return rig_.tally(); }
  [[nodiscard]] const RigFacts& facts() const { return rig_.facts(); }
  [[nodiscard]] const RigOptions& rig() const { return rig_.options(); }
  [[nodiscard]] const PinholeIntrinsics& intrinsics() const { return camera_.intrinsics(); }

 private:
  SteeredRig(sim::RayCaster world, sim::StereoCamera camera, sim::TrackerModel tracker,
             const sim::PoseFaults& faults, const SteeredRigOptions& options,
             const Transform<World, Body>& start);
  [[nodiscard]] Transform<World, Body> at(Stamp stamp, Stamp now,
                                          const Transform<World, Body>& T_world_body) const;
  void deliver(Stamp until);

  sim::RayCaster world_;
  sim::StereoCamera camera_;
  sim::TrackerModel tracker_;
  sim::PoseDelivery delivery_;
  Rig rig_;
  Transform<Body, Camera> T_body_camera_;
  double rate_hz_;
  Stamp last_stamp_{};
  Transform<World, Body> last_T_world_body_;
  std::uint64_t images_ = 0;
  std::optional<PoseSample> believed_;
};

}  // namespace swiftlet
