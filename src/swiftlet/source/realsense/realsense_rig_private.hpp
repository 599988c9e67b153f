// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/live/device_supervisor.hpp"
#include "swiftlet/source/live/pose_socket.hpp"
#include "swiftlet/source/realsense/realsense_devices_private.hpp"
#include "swiftlet/source/realsense/realsense_driver_private.hpp"
#include "swiftlet/source/rig/rig_file.hpp"

namespace swiftlet {

/// What `realsense:REST` asks for.
struct RealsenseRequest {
  RigDescription rig;  ///< the serial number of a camera is its `stream`; empty: any
  RealsenseProfile profile;
  std::optional<PoseAddress> poses;  ///< absent: of a T265
  std::filesystem::path pose_key;    ///< see PoseAddress
  Nanoseconds timeout = std::chrono::seconds(10);
  DeviceSupervisor::Options keeper{};
  std::string uri;
};
/// Errors: kUsage, and those of the rig file.
[[nodiscard]] Expected<RealsenseRequest> parse_realsense(std::string_view rest);

/// Stands between a device and whoever starts it, as a recorder does. `kind` is "depth" or "t265".
using WrapRealsense = std::function<rs2::device(const RealsenseDevice&, std::string_view kind)>;

/// Finds and prepares the cameras of a request, in the order of the rig, and looks for its tracker.
/// Errors: kNotFound if one of them is not there; those of prepare_depth().
[[nodiscard]] Expected<std::vector<RealsenseDepthInfo>> survey_realsense(
    RealsenseDevices& devices, const RealsenseRequest& request);

/// The cameras of a rig and its pose source, kept alive while they deliver into a sink.
class RealsenseRig {
 public:
  /// Errors: those of listen_for_poses(). REQUIRES: the sink outlives the rig.
  [[nodiscard]] static Expected<std::unique_ptr<RealsenseRig>> start(
      RealsenseDevicesPtr devices, const RealsenseRequest& request, LiveSink& sink,
      WrapRealsense wrap = {});
  RealsenseRig(const RealsenseRig&) = delete;
  RealsenseRig& operator=(const RealsenseRig&) = delete;
  ~RealsenseRig();

 private:
  RealsenseRig(RealsenseDevicesPtr devices, const RealsenseRequest& request, LiveSink& sink,
               WrapRealsense wrap);
  [[nodiscard]] std::vector<LiveInstrument> instruments();
  [[nodiscard]] Expected<LiveStreamPtr> connect_camera(std::size_t camera);
  [[nodiscard]] Expected<LiveStreamPtr> connect_tracker();
  [[nodiscard]] rs2::device wrapped(const RealsenseDevice& device, std::string_view kind) const;
  void note_removed(const RealsenseDevices::WasRemoved& was_removed);

  RealsenseDevicesPtr devices_;
  const RealsenseRequest request_;
  LiveSink& sink_;
  const WrapRealsense wrap_;
  LiveStreamPtr pose_socket_;
  std::mutex mutex_;                                   // of the next line
  std::vector<std::optional<RealsenseDevice>> taken_;  // by instrument, as last started
  std::unique_ptr<DeviceSupervisor> supervisor_;       // last: its thread uses the rest
};

/// The source `realsense:` on whatever devices there are. Errors: those of
/// survey_realsense() and RealsenseRig::start().
[[nodiscard]] Expected<FrameSourcePtr> open_realsense(RealsenseDevicesPtr devices,
                                                      const RealsenseRequest& request);
/// See record_realsense().
[[nodiscard]] Expected<LiveRecordingPtr> record_realsense(const RealsenseDevicesPtr& devices,
                                                          const RealsenseRequest& request,
                                                          const std::filesystem::path& folder);

}  // namespace swiftlet
