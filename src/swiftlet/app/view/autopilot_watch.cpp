// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/autopilot_watch.hpp"

#include <chrono>

#include "swiftlet/app/events.hpp"
#include "swiftlet/mavlink/companion/mapped_frame.hpp"
#include "swiftlet/source/live/live_sink.hpp"

namespace swiftlet::app {
namespace {

std::vector<Transform<Body, Camera>> mounts_of(const RigOptions* rig) {
  if (rig == nullptr) return {Transform<Body, Camera>{}};
  std::vector<Transform<Body, Camera>> mounts;
  for (const RigCamera& camera : rig->cameras) mounts.push_back(camera.T_body_camera);
  return mounts;
}

/// From the autopilot's thread to the rig.
class PoseRelay final : public mavlink::PoseTaker {
 public:
  explicit PoseRelay(LiveSink& sink) : sink_(sink) {}
  void take(const PoseSample& pose) override { sink_.push(pose); }
  void start_anew() override { sink_.start_poses_anew(); }

 private:
  LiveSink& sink_;
};

bool concerns_the_pilot(RigEventKind kind) {
  return kind == RigEventKind::kUnplugged || kind == RigEventKind::kStalled ||
         kind == RigEventKind::kNotStarted || kind == RigEventKind::kRestarted;
}

}  // namespace

AutopilotWatch::AutopilotWatch(FrameSource& source) : mounts_(mounts_of(source.rig())) {
  if (LiveSink* const sink = source.pose_sink()) relay_ = std::make_unique<PoseRelay>(*sink);
}

Expected<std::unique_ptr<AutopilotWatch>> AutopilotWatch::start(const MavlinkFlags& flags,
                                                                const MapperConfig& config,
                                                                FrameSource& source) {
  auto options = autopilot_options(flags, config, source.rig());
  if (!options) return forward_error(std::move(options));
  std::unique_ptr<AutopilotWatch> watch(new AutopilotWatch(source));
  if (watch->relay_ && options->companion.poses != mavlink::PoseTelling::kNone) {
    return fail(ErrorCode::kUsage, "--mavlink-poses",
                "the poses are the autopilot's own, which must not come back to it",
                "leave the option out");
  }
  options->companion.pose_taker = watch->relay_.get();
  auto autopilot = mavlink::Autopilot::start(std::move(*options));
  if (!autopilot) return forward_error(std::move(autopilot));
  watch->autopilot_ = std::move(*autopilot);
  return watch;
}

void AutopilotWatch::map_begun(const Mapper& mapper) {
  autopilot_->news().map_begun(mapper.reader());
}

void AutopilotWatch::frame_done(const Frame& frame, const MapUpdate& update, const Mapper&) {
  if (update.verdict != FrameVerdict::kIntegrated || !update.was_published) return;
  const Stamp unix_now{Nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
  const auto& mount = mounts_[frame.camera < mounts_.size() ? frame.camera : 0];
  autopilot_->news().mapped(mavlink::mapped_frame(frame, mount, HostTime::clock::now(), unix_now));
}

void AutopilotWatch::tell_pilot(const std::vector<RigEvent>& events) {
  for (const RigEvent& event : events) {
    if (!concerns_the_pilot(event.kind)) continue;
    const auto urgency = event.kind == RigEventKind::kRestarted ? mavlink::Urgency::kInfo
                                                                : mavlink::Urgency::kCritical;
    autopilot_->news().tell_pilot(urgency, "mapper: " + event_text(event));
  }
}

}  // namespace swiftlet::app
