// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/trusted_poses.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig/body_box.hpp"
#include "swiftlet/source/rig_statistics.hpp"

namespace swiftlet {

/// Cameras that a rig can have.
inline constexpr std::size_t kMaxCameras = 8;

/// One depth camera of a rig.
struct RigCamera {
  std::string name = "depth";               ///< shown to people
  Transform<Body, Camera> T_body_camera{};  ///< the mount (extrinsics)
  /// A pose that belongs to an image of time t is stamped t + pose_offset.
  Nanoseconds pose_offset{0};
  double baseline_m = 0.0;  ///< of its stereo pair; 0: as the mapper is configured
  std::string stream{};     ///< topic, serial number or folder that it comes from; empty: found

  /// For people: "camera 'depth'".
  [[nodiscard]] std::string title() const { return "camera '" + name + "'"; }
};

/// How an image gets its pose.
enum class PosePairing : std::uint8_t {
  kInterpolate,
  kNearest,  ///< the nearest pose as it is: only to show what interpolation is worth
};

/// What a rig consists of and what it may believe.
struct RigOptions {
  std::vector<RigCamera> cameras{RigCamera{}};      ///< 1 .. kMaxCameras
  TrustedPoses::Options poses{};                    ///< which poses are trusted
  PosePairing pairing = PosePairing::kInterpolate;  ///< how an image gets its pose
  std::optional<BodyBox> body_box{};                ///< what of the vehicle its cameras see
  std::size_t max_waiting = 8;  ///< depth images a camera that may wait for their pose
  /// No image arrives after one that is stamped this much later.
  Nanoseconds reorder_window = std::chrono::milliseconds(40);
  /// The tracker is silent when images are this much ahead of its newest pose; after a step of
  /// their own time, when they have gone on for so long without a pose.
  Nanoseconds stale_after = std::chrono::milliseconds(500);
};

/// What the gates before a rig have seen of its stamps (RigGates).
struct StampTally {
  std::size_t images_refused = 0;  ///< images whose stamps could not be used
  std::size_t poses_refused = 0;   ///< poses whose stamps could not be used
  ClockSteps pose_clock{};         ///< times that the clock of the poses was set
  ClockSteps image_clock{};        ///< times that a clock of the images was set
};

/// Joins the depth images of one to eight cameras with a stream of poses into posed frames: the one
/// path that simulated, recorded and live rigs share. An image waits until a pose at or after its
/// time has come, and until no other camera can deliver an earlier one; then it gets the pose
/// interpolated at its own time and the mount of its camera.
///
/// Order: frames come out by time, those of one time by camera, however the cameras' images were
/// mixed on arrival within `reorder_window`. So the same recording gives the same map.
/// Memory: PoseTrack's capacity and at most `max_waiting` images a camera; the oldest waiting one
/// is lost (counted). Thread safety: none, one owner.
class Rig {
 public:
  using Options = RigOptions;  ///< cameras, mounts and gates

  /// REQUIRES: 1 to kMaxCameras cameras.
  explicit Rig(const Options& options);

  /// A pose of the tracker, in the order of their stamps.
  void push(const PoseSample& pose);
  /// The pose source was switched off and on: a new epoch begins with its next pose.
  void start_poses_anew() { poses_.start_anew(); }
  /// The clock of the poses, or of one camera, was set back: its next sample is stamped `first`.
  /// What waits for a pose of the time before is lost (counted), what was mapped is not mapped
  /// again. Frames are later than those before all the same: their stamps go on.
  void restart_pose_clock(Stamp first);
  /// The clock of a camera begins anew with this stamp.
  void restart_camera_clock(std::size_t camera, Stamp first);
  /// Counts what was refused before it came here.
  void note_stamps(const StampTally& stamps);
  /// The images of one camera come in time order; one that does not is lost (counted).
  /// REQUIRES: depth.camera is one of the rig's.
  void push(DepthFrame depth);
  /// An image of which there is no more than its loss.
  void lose(FrameLoss loss) { ++tally_.of(loss); }
  /// Nothing more will come: what still waits is decided now.
  void finish() { is_finished_ = true; }

  /// The oldest depth image whose pose is known by now; nullopt if none is ready.
  [[nodiscard]] std::optional<Frame> pop();

  /// What was lost so far.
  [[nodiscard]] const FrameTally& tally() const { return tally_; }
  /// What the streams were like so far.
  [[nodiscard]] const RigStatistics& statistics() const { return facts_; }
  /// Whose clock the poses are stamped with.
  [[nodiscard]] ClockDomain pose_clock() const { return poses_.clock(); }
  /// Where the body was, as far as poses that are trusted tell.
  [[nodiscard]] tl::expected<TrackedPose, PoseMiss> pose_at(Stamp stamp) const {
    return poses_.track().find(stamp);
  }
  /// As given.
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  struct Order {
    Stamp stamp;
    std::uint8_t camera;
    friend auto operator<=>(const Order&, const Order&) = default;
  };
  static Order order_of(const DepthFrame& depth) { return {depth.stamp, depth.camera}; }
  [[nodiscard]] Stamp pose_time(const DepthFrame& depth) const;
  [[nodiscard]] bool is_settled(Stamp stamp) const;
  [[nodiscard]] std::optional<FrameLoss> loss_of(const DepthFrame& depth, PoseMiss miss) const;
  [[nodiscard]] Frame posed(DepthFrame depth, const TrackedPose& pose);
  void watch_staleness();
  void note_step_to(Stamp stamp);
  void count_refused_poses();
  template <class IsOld>
  void lose_waiting(IsOld is_old);

  Options options_;
  TrustedPoses poses_;
  std::deque<DepthFrame> waiting_;                 // in Order, all different
  std::vector<std::optional<Stamp>> last_stamp_;   // by camera
  std::vector<std::optional<BodyBoxMask>> masks_;  // by camera
  std::optional<Order> last_decided_;
  std::optional<Order> last_delivered_;  // by this clock of the poses
  std::optional<Stamp> newest_depth_;
  std::optional<Stamp> resumed_at_;  // of the image after a pause or a clock that was set ahead
  std::optional<Stamp> last_out_;    // of the newest frame
  Nanoseconds out_offset_{0};        // of frames' stamps against images': a set clock is taken out
  bool is_out_offset_known_ = true;
  FrameTally tally_;
  RigStatistics facts_;
  bool is_stale_ = false;
  bool is_finished_ = false;
};

}  // namespace swiftlet
