// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "swiftlet/source/realsense/realsense_driver_private.hpp"

namespace swiftlet {
namespace {

/// Sets an option if the sensor has it, within the limits it tells.
void set_option(const rs2::sensor& sensor, rs2_option option, float value) {
  if (!sensor.supports(option)) return;
  const auto range = sensor.get_option_range(option);
  sensor.set_option(option, std::clamp(value, range.min, range.max));
}

void set_depth_options(const rs2::sensor& sensor, const RealsenseProfile& wanted) {
  if (sensor.supports(RS2_OPTION_VISUAL_PRESET))
    set_option(sensor, RS2_OPTION_VISUAL_PRESET, wanted.visual_preset);
  set_option(sensor, RS2_OPTION_EMITTER_ENABLED, 1.0F);
  set_option(sensor, RS2_OPTION_LASER_POWER, wanted.laser_mw);
  set_option(sensor, RS2_OPTION_ENABLE_AUTO_EXPOSURE, 1.0F);
#if RS2_API_VERSION >= 22200
  set_option(sensor, RS2_OPTION_GLOBAL_TIME_ENABLED, 1.0F);
#endif
}

Expected<RealsenseDepthInfo> depth_info(const rs2::sensor& sensor,
                                        const rs2::video_stream_profile& profile) {
  const rs2_intrinsics K = profile.get_intrinsics();
  if (std::ranges::any_of(K.coeffs, [](float c) { return c != 0.0F; }))
    return fail(ErrorCode::kUnsupported, "realsense", "its depth has lens distortion");
  auto intrinsics = PinholeIntrinsics::create(K.width, K.height, K.fx, K.fy, K.ppx, K.ppy);
  if (!intrinsics) return forward_error(std::move(intrinsics));
  const auto option_or = [&](rs2_option option, float fallback) {
    return sensor.supports(option) ? sensor.get_option(option) : fallback;
  };
  return RealsenseDepthInfo{*intrinsics, option_or(RS2_OPTION_DEPTH_UNITS, 0.001F),
                            double{option_or(RS2_OPTION_STEREO_BASELINE, 0.0F)} * 1e-3};
}

bool is_wanted(const rs2::stream_profile& profile, const RealsenseProfile& wanted) {
  const auto video = profile.as<rs2::video_stream_profile>();
  return video && profile.stream_type() == RS2_STREAM_DEPTH && profile.format() == RS2_FORMAT_Z16 &&
         video.width() == wanted.width && video.height() == wanted.height &&
         profile.fps() == wanted.fps;
}

Expected<LiveStreamPtr> start_stream(const rs2::sensor& sensor, const rs2::stream_profile& profile,
                                     std::function<void(const rs2::frame&)> take) {
  sensor.open(profile);
  auto stream = std::make_unique<RealsenseStream>(sensor);
  sensor.start([take = std::move(take)](const rs2::frame& frame) { take(frame); });
  return stream;
}

}  // namespace

RealsenseStream::~RealsenseStream() {
  // The camera may have been unplugged: then there is nothing to stop.
  (void)with_sdk([&]() -> Status {
    sensor_.stop();
    return Done{};
  });
  (void)with_sdk([&]() -> Status {
    sensor_.close();
    return Done{};
  });
}

Expected<RealsenseDepthSensor> prepare_depth(const rs2::device& device,
                                             const RealsenseProfile& wanted) {
  return with_sdk([&]() -> Expected<RealsenseDepthSensor> {
    std::set<std::string> known;
    for (const rs2::sensor& sensor : device.query_sensors()) {
      for (const rs2::stream_profile& profile : sensor.get_stream_profiles()) {
        if (profile.stream_type() != RS2_STREAM_DEPTH) continue;
        if (is_wanted(profile, wanted)) {
          set_depth_options(sensor, wanted);
          auto info = depth_info(sensor, profile.as<rs2::video_stream_profile>());
          if (!info) return forward_error(std::move(info));
          return RealsenseDepthSensor{sensor, profile, *info};
        }
        const auto video = profile.as<rs2::video_stream_profile>();
        known.insert(fmt::format("{}x{}@{}", video.width(), video.height(), profile.fps()));
      }
    }
    std::string sizes;
    for (const std::string& size : known) sizes += (sizes.empty() ? "" : ", ") + size;
    return fail(ErrorCode::kNotFound, "realsense",
                fmt::format("the camera has no depth of {}x{} at {} Hz", wanted.width,
                            wanted.height, wanted.fps),
                sizes.empty() ? "it has no depth at all"
                              : "it has " + sizes + "; USB 2 has fewer than USB 3");
  });
}

Expected<LiveStreamPtr> start_depth(const RealsenseDepthSensor& depth, std::uint8_t camera,
                                    LiveSink& sink) {
  return with_sdk([&] {
    return start_stream(depth.sensor, depth.profile,
                        [info = depth.info, camera, &sink](const rs2::frame& frame) {
                          take_depth(frame, info, camera, sink);
                        });
  });
}

Expected<LiveStreamPtr> start_poses(const rs2::device& device, LiveSink& sink) {
  return with_sdk([&]() -> Expected<LiveStreamPtr> {
    for (const rs2::sensor& sensor : device.query_sensors()) {
      for (const rs2::stream_profile& profile : sensor.get_stream_profiles()) {
        if (profile.stream_type() != RS2_STREAM_POSE) continue;
#if RS2_API_VERSION >= 22500
        set_option(sensor, RS2_OPTION_ENABLE_MAPPING, 1.0F);
        set_option(sensor, RS2_OPTION_ENABLE_RELOCALIZATION, 0.0F);
        set_option(sensor, RS2_OPTION_ENABLE_POSE_JUMPING, 0.0F);
#endif
        return start_stream(sensor, profile, [&sink](const rs2::frame& frame) {
          (void)with_sdk([&]() -> Status {
            if (auto pose = frame.as<rs2::pose_frame>())
              take_pose(pose.get_pose_data(), frame.get_timestamp(),
                        frame.get_frame_timestamp_domain(), sink);
            return Done{};
          });
        });
      }
    }
    return fail(ErrorCode::kNotFound, "realsense", "the device has no poses",
                "a T265 needs SDK 2.53.1 or older");
  });
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
