// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig.hpp"
#include "swiftlet/source/streams.hpp"

namespace swiftlet {

/// Plays recorded streams through a Rig, images by time and each with the poses up to it, however
/// the recording has mixed them: the result depends on the stamps alone.
/// Memory: one image a camera ahead of the Rig.
class JoinedSource final : public FrameSource {
 public:
  /// `cameras` in the order of the rig's. REQUIRES: as many as the rig has.
  JoinedSource(SourceInfo info, std::vector<DepthStreamPtr> cameras, PoseStreamPtr poses,
               const Rig::Options& rig);

  /// Errors, besides those of the streams: kCorruptInput if not one of the first 90 images is of
  /// the poses' clock; that of the first bad image if no frame came out.
  [[nodiscard]] Expected<std::optional<Frame>> next() override;
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] const FrameTally& tally() const override { return rig_.tally(); }
  [[nodiscard]] const RigFacts* facts() const override { return &rig_.facts(); }
  [[nodiscard]] const RigOptions* rig() const override { return &rig_.options(); }
  [[nodiscard]] std::vector<RigEvent> take_events() override { return skipped_.take_events(); }
  void stop_when(const std::function<bool()>& is_unwanted) override { is_unwanted_ = is_unwanted; }

 private:
  struct Camera {
    DepthStreamPtr stream;
    std::optional<DepthFrame> ahead;  // the next image
    bool is_over = false;
  };
  [[nodiscard]] Expected<bool> advance();  // false at the end of all streams
  [[nodiscard]] Status fill();
  [[nodiscard]] Status push_poses_until(Stamp stamp);
  [[nodiscard]] Status check_clocks();

  SourceInfo info_;
  std::vector<Camera> cameras_;
  PoseStreamPtr poses_;
  Rig rig_;
  std::function<bool()> is_unwanted_;
  ClockDomain image_clock_ = ClockDomain::kUnspecified;
  SkippedRecords skipped_;
  std::optional<Error> fault_;  // of a stream
  bool is_played_ = false;      // the streams are at their end, or one of them has a fault
  bool has_ended_ = false;
};

}  // namespace swiftlet
