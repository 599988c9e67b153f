// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/source/realsense/realsense_rig_private.hpp"

namespace swiftlet {
namespace {

using Taken = std::vector<std::optional<RealsenseDevice>>;

/// The device of a camera: the one of its serial number, or the first that is no other camera's.
Expected<RealsenseDevice> find_camera(RealsenseDevices& devices, const RealsenseRequest& request,
                                      std::size_t camera, const Taken& taken) {
  const std::vector<RigCamera>& cameras = request.rig.rig.cameras;
  const std::string& wanted = cameras[camera].stream;
  const auto is_others = [&](const std::string& serial) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (i == camera) continue;
      if (cameras[i].stream == serial || (taken[i] && taken[i]->facts.serial == serial))
        return true;
    }
    return false;
  };
  std::string there;
  for (RealsenseDevice& device : devices.list()) {
    if (!device.facts.has_depth()) continue;
    const std::string& serial = device.facts.serial;
    there += (there.empty() ? "" : ", ") + serial;
    if (wanted.empty() ? !is_others(serial) : wanted == serial) return std::move(device);
  }
  return fail(
      ErrorCode::kNotFound, "realsense:" + wanted,
      "no such RealSense camera with depth is connected",
      there.empty() ? "check the cable and the udev rules of the SDK" : "connected are: " + there);
}

Expected<RealsenseDevice> find_tracker(RealsenseDevices& devices) {
  for (RealsenseDevice& device : devices.list()) {
    if (device.facts.has_poses) return std::move(device);
  }
  return fail(ErrorCode::kNotFound, "realsense:", "no T265 is connected",
              "SDK 2.53.1 is the last that knows it; any other pose source can take its place with "
              "?poses=udp:PORT (docs/realsense.md)");
}

}  // namespace

Expected<std::vector<RealsenseDepthInfo>> survey_realsense(RealsenseDevices& devices,
                                                           const RealsenseRequest& request) {
  std::vector<RealsenseDepthInfo> infos;
  Taken taken(request.rig.rig.cameras.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    auto device = find_camera(devices, request, i, taken);
    if (!device) return forward_error(std::move(device));
    auto prepared = prepare_depth(device->device, request.profile);
    if (!prepared) return forward_error(std::move(prepared));
    infos.push_back(prepared->info);
    taken[i] = std::move(*device);
  }
  if (request.poses) return infos;
  if (auto tracker = find_tracker(devices); !tracker) return forward_error(std::move(tracker));
  return infos;
}

RealsenseRig::RealsenseRig(RealsenseDevicesPtr devices, const RealsenseRequest& request,
                           LiveSink& sink, WrapRealsense wrap)
    : devices_(std::move(devices)),
      request_(request),
      sink_(sink),
      wrap_(std::move(wrap)),
      taken_(request.rig.rig.cameras.size() + 1) {}

Expected<std::unique_ptr<RealsenseRig>> RealsenseRig::start(RealsenseDevicesPtr devices,
                                                            const RealsenseRequest& request,
                                                            LiveSink& sink, WrapRealsense wrap) {
  std::unique_ptr<RealsenseRig> rig(
      new RealsenseRig(std::move(devices), request, sink, std::move(wrap)));
  if (request.poses) {
    auto socket = listen_for_poses(*request.poses, request.rig.pose_axes, sink);
    if (!socket) return forward_error(std::move(socket));
    rig->pose_socket_ = std::move(*socket);
  }
  auto keeper = DeviceSupervisor::start(sink, rig->instruments(), request.keeper);
  if (!keeper) return forward_error(std::move(keeper));
  rig->supervisor_ = std::move(*keeper);
  rig->devices_->on_removed([raw = rig.get()](const RealsenseDevices::WasRemoved& was_removed) {
    raw->note_removed(was_removed);
  });
  return rig;
}

RealsenseRig::~RealsenseRig() {
  devices_->on_removed({});
  std::unique_ptr<DeviceSupervisor> keeper;  // its thread may wait for the lock
  const std::lock_guard lock(mutex_);
  keeper.swap(supervisor_);
}

std::vector<LiveInstrument> RealsenseRig::instruments() {
  std::vector<LiveInstrument> all;
  const std::vector<RigCamera>& cameras = request_.rig.rig.cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    all.push_back({cameras[i].title(), [this, i] { return connect_camera(i); },
                   [this, i] { return sink_.last_image(i); }});
  }
  const auto last_pose = [this] { return sink_.last_pose(); };
  if (request_.poses) {
    all.push_back(
        {request_.poses->title(), [] { return std::make_unique<LiveStream>(); }, last_pose, false});
  } else {
    all.push_back({"T265", [this] { return connect_tracker(); }, last_pose});
  }
  return all;
}

rs2::device RealsenseRig::wrapped(const RealsenseDevice& device, std::string_view kind) const {
  return wrap_ ? wrap_(device, kind) : device.device;
}

void RealsenseRig::note_removed(const RealsenseDevices::WasRemoved& was_removed) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < taken_.size(); ++i) {
    if (supervisor_ && taken_[i] && was_removed(taken_[i]->device)) supervisor_->note_unplugged(i);
  }
}

Expected<LiveStreamPtr> RealsenseRig::connect_camera(std::size_t camera) {
  Taken taken;
  {
    const std::lock_guard lock(mutex_);
    taken = taken_;
  }
  auto device = find_camera(*devices_, request_, camera, taken);
  if (!device) return forward_error(std::move(device));
  if (device->facts.usb.starts_with('2')) {
    sink_.note({RigEventKind::kSlowUsb, request_.rig.rig.cameras[camera].title(),
                "it is on a USB 2 port: use a USB 3 port and cable of its own"});
  }
  return with_sdk([&]() -> Expected<LiveStreamPtr> {
    auto prepared = prepare_depth(wrapped(*device, "depth"), request_.profile);
    if (!prepared) return forward_error(std::move(prepared));
    auto stream = start_depth(*prepared, static_cast<std::uint8_t>(camera), sink_);
    const std::lock_guard lock(mutex_);
    if (stream) taken_[camera] = *device;
    return stream;
  });
}

Expected<LiveStreamPtr> RealsenseRig::connect_tracker() {
  auto device = find_tracker(*devices_);
  if (!device) return forward_error(std::move(device));
  return with_sdk([&]() -> Expected<LiveStreamPtr> {
    const bool was_there = taken_.back().has_value();
    if (was_there) sink_.start_poses_anew();  // a T265 begins a new world when it starts
    auto stream = start_poses(wrapped(*device, "t265"), sink_);
    const std::lock_guard lock(mutex_);
    if (stream) taken_.back() = *device;
    return stream;
  });
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
