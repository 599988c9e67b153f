// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/autopilot_watch.hpp"

#include <chrono>

#include "swiftlet/app/events.hpp"
#include "swiftlet/mavlink/companion/mapped_frame.hpp"

namespace swiftlet::app {
namespace {

std::vector<Transform<Body, Camera>> mounts_of(const RigOptions* rig) {
  if (rig == nullptr) return {Transform<Body, Camera>{}};
  std::vector<Transform<Body, Camera>> mounts;
  for (const RigCamera& camera : rig->cameras) mounts.push_back(camera.T_body_camera);
  return mounts;
}

bool concerns_the_pilot(RigEventKind kind) {
  return kind == RigEventKind::kUnplugged || kind == RigEventKind::kStalled ||
         kind == RigEventKind::kNotStarted || kind == RigEventKind::kRestarted;
}

}  // namespace

Expected<std::unique_ptr<AutopilotWatch>> AutopilotWatch::start(const MavlinkFlags& flags,
                                                                const MapperConfig& config,
                                                                const FrameSource& source) {
  auto options = autopilot_options(flags, config, source.rig());
  if (!options) return forward_error(std::move(options));
  auto autopilot = mavlink::Autopilot::start(std::move(*options));
  if (!autopilot) return forward_error(std::move(autopilot));
  return std::unique_ptr<AutopilotWatch>(
      new AutopilotWatch(std::move(*autopilot), mounts_of(source.rig())));
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
