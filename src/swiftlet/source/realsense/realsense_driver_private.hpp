// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <fmt/format.h>

#include <librealsense2/rs.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/source/live/device_supervisor.hpp"

// The RealSense SDK at sensor level: neither pipeline nor syncer, which drop frames and poses.
// Version guards: global time since 2.22, options of the T265 since 2.25, unit per frame
// since 2.37. SDK 2.53.1 is the last that can talk to a T265.

namespace swiftlet {

/// Calls the SDK, which reports by exception; none passes: kIo with its words.
template <class Call>
auto with_sdk(Call call) -> decltype(call()) {
  try {
    return call();
  } catch (const rs2::error& error) {
    return fail(ErrorCode::kIo, "realsense",
                fmt::format("{}: {}", error.get_failed_function(), error.what()),
                "plug the camera in again, on a USB 3 port");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kIo, "realsense", error.what());
  }
}

/// How a depth camera streams.
struct RealsenseProfile {
  int width = 848;
  int height = 480;
  int fps = 30;
  float laser_mw = 150.0F;
  float visual_preset = 3.0F;  ///< High Accuracy: few false points
};

/// A sensor that streams until the object goes away.
class RealsenseStream final : public LiveStream {
 public:
  explicit RealsenseStream(const rs2::sensor& sensor) : sensor_(sensor) {}
  RealsenseStream(const RealsenseStream&) = delete;
  RealsenseStream& operator=(const RealsenseStream&) = delete;
  ~RealsenseStream() override;

 private:
  rs2::sensor sensor_;
};

/// What is known of a depth camera before its first image.
struct RealsenseDepthInfo {
  PinholeIntrinsics intrinsics;
  float unit_m;
  double baseline_m;  ///< 0 if the device does not tell
};

/// The depth sensor of a device and the profile it would stream; its options are set as asked.
struct RealsenseDepthSensor {
  rs2::sensor sensor;
  rs2::stream_profile profile;
  RealsenseDepthInfo info;
};
/// Errors: kNotFound naming the sizes there are; kUnsupported for distorted images; kIo with the
/// SDK's words.
[[nodiscard]] Expected<RealsenseDepthSensor> prepare_depth(const rs2::device& device,
                                                           const RealsenseProfile& wanted);
/// Streams depth into a sink as images of a camera. Errors: kIo with the SDK's words.
[[nodiscard]] Expected<LiveStreamPtr> start_depth(const RealsenseDepthSensor& depth,
                                                  std::uint8_t camera, LiveSink& sink);

/// Streams the poses of a T265 into a sink, with relocalisation and jumping off and mapping on.
/// Errors: kNotFound if the device has none, kIo with the SDK's words.
[[nodiscard]] Expected<LiveStreamPtr> start_poses(const rs2::device& device, LiveSink& sink);

/// What the callbacks do with a frame; never throws.
void take_depth(const rs2::frame& frame, const RealsenseDepthInfo& info, std::uint8_t camera,
                LiveSink& sink);
void take_pose(const rs2_pose& pose, double timestamp_ms, rs2_timestamp_domain domain,
               LiveSink& sink);

}  // namespace swiftlet
