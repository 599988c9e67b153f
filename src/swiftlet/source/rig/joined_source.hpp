// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/rig_gates.hpp"
#include "swiftlet/source/streams.hpp"

namespace swiftlet {

/// Plays recorded streams through a Rig, images by time and each with the poses up to it, however
/// the recording has mixed them: the result depends on the stamps alone. Where the clock of the
/// recording was set back, the images after that get the poses after that.
/// Memory: one image a camera ahead of the Rig, and those that its gate holds.
class JoinedSource final : public FrameSource {
 public:
  /// `cameras` in the order of the rig's. REQUIRES: as many as the rig has.
  JoinedSource(SourceInfo info, std::vector<DepthStreamPtr> cameras, PoseStreamPtr poses,
               const Rig::Options& rig);

  /// Errors, besides those of the streams: kCorruptInput if not one of the first 90 images is of
  /// the poses' clock; that of the first bad image if no frame came out.
  [[nodiscard]] Expected<std::optional<Frame>> next() override;
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] const FrameTally& tally() const override { return tally_; }
  [[nodiscard]] const RigStatistics* statistics() const override { return &rig_.statistics(); }
  [[nodiscard]] const RigOptions* rig() const override { return &rig_.options(); }
  void stop_when(const std::function<bool()>& is_unwanted) override { is_unwanted_ = is_unwanted; }
  [[nodiscard]] std::vector<RigEvent> take_events() override;

 private:
  struct Camera {
    DepthStreamPtr stream;
    std::optional<DepthFrame> ahead{};  // the next image
    bool is_over = false;
    bool was_set_back = false;    // its clock, right before `ahead`
    std::size_t clock = 0;        // times that was seen
    std::size_t matched = 0;      // by poses, of poses_clock_
    std::size_t passed_over = 0;  // images of others that came first for their older clock
    std::optional<Stamp> last{};  // of the newest image that was pushed
    bool is_silent = false;       // told
  };
  [[nodiscard]] Expected<bool> advance();  // false at the end of all streams
  void take_stock();
  void fill();
  void fill(Camera& camera, std::size_t number);
  [[nodiscard]] Camera* earliest();
  void watch_silence(Stamp now);
  void tell(RigEventKind kind, std::size_t camera, std::string what);
  [[nodiscard]] Expected<bool> look_at_pose();
  void push_pose();
  [[nodiscard]] Status follow_set_clock(Camera& camera, Stamp first);
  [[nodiscard]] Status push_poses_until(Stamp stamp);

  [[nodiscard]] Status check_clocks();

  SourceInfo info_;
  std::vector<Camera> cameras_;
  PoseStreamPtr poses_;
  Rig rig_;
  RigGates gates_;
  FrameTally tally_;
  RigEventList events_;
  RigEventCounts event_counts_{};
  std::optional<PoseSample> pose_ahead_;
  bool pose_was_set_back_ = false;  // the clock, right before pose_ahead_
  std::size_t poses_clock_ = 0;     // times that the rig was told so
  std::size_t waited_ = 0;          // images that pose_ahead_ has waited for the cameras' clock
  std::optional<Stamp> start_;      // of the first image
  std::function<bool()> is_unwanted_;
  ClockDomain image_clock_ = ClockDomain::kUnspecified;
  SkippedRecords skipped_;
  std::optional<Error> fault_;  // of a stream
  bool is_played_ = false;      // the streams are at their end, or one of them has a fault
  bool has_ended_ = false;
};

}  // namespace swiftlet
