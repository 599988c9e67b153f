// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "swiftlet/source/realsense_driver_private.hpp"
#include "swiftlet/source/t265_axes.hpp"

namespace swiftlet {
namespace {

constexpr double kLongestExposure_ms = 200.0;

ClockDomain clock_from(rs2_timestamp_domain domain) {
  if (domain == RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME) return ClockDomain::kSystem;
#if RS2_API_VERSION >= 22200
  if (domain == RS2_TIMESTAMP_DOMAIN_GLOBAL_TIME) return ClockDomain::kGlobal;
#endif
  return ClockDomain::kDevice;
}

/// Milliseconds of a double; exact to 0.3 us at today's epoch. nullopt for what is no time.
std::optional<Stamp> stamp_from(double ms) {
  if (!(std::abs(ms) < 9.2e12)) return std::nullopt;
  const double whole_ms = std::floor(ms);
  return Stamp{std::llround(whole_ms) * 1'000'000 + std::llround((ms - whole_ms) * 1e6)};
}

/// The stamp is that of the read-out: how long before it the middle of the exposure was [ms].
double exposure_lag_ms(const rs2::frame& frame) {
  if (!frame.supports_frame_metadata(RS2_FRAME_METADATA_FRAME_TIMESTAMP) ||
      !frame.supports_frame_metadata(RS2_FRAME_METADATA_SENSOR_TIMESTAMP))
    return 0.0;
  const auto read_out_us = frame.get_frame_metadata(RS2_FRAME_METADATA_FRAME_TIMESTAMP);
  const auto exposure_us = frame.get_frame_metadata(RS2_FRAME_METADATA_SENSOR_TIMESTAMP);
  const double lag_ms = 1e-3 * static_cast<double>(read_out_us - exposure_us);
  return lag_ms > 0.0 && lag_ms < kLongestExposure_ms ? lag_ms : 0.0;
}

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

DepthImage copied(const rs2::video_frame& video, float unit_m) {
  DepthImage depth{Image<std::uint16_t>(video.get_width(), video.get_height()), unit_m};
  const auto* bytes = static_cast<const std::byte*>(video.get_data());
  for (int v = 0; v < depth.raw.height(); ++v) {
    const auto row = depth.raw.row(v);
    std::memcpy(row.data(), bytes + static_cast<std::ptrdiff_t>(v) * video.get_stride_in_bytes(),
                row.size_bytes());
  }
  return depth;
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

void take_depth(const rs2::frame& frame, const RealsenseDepthInfo& info, std::uint8_t camera,
                LiveSink& sink) {
  // A frame that cannot be read is one less; the SDK must not see an exception in its callback.
  (void)with_sdk([&]() -> Status {
    const auto video = frame.as<rs2::video_frame>();
    const auto stamp = stamp_from(frame.get_timestamp() - exposure_lag_ms(frame));
    if (!video || !stamp) return Done{};
    float unit_m = info.unit_m;
#if RS2_API_VERSION >= 23700
    if (const auto depth = frame.as<rs2::depth_frame>()) unit_m = depth.get_units();
#endif
    sink.push(DepthFrame{*stamp, copied(video, unit_m), info.intrinsics, camera,
                         clock_from(frame.get_frame_timestamp_domain())});
    return Done{};
  });
}

void take_pose(const rs2_pose& pose, double timestamp_ms, rs2_timestamp_domain domain,
               LiveSink& sink) {
  const auto stamp = stamp_from(timestamp_ms);
  if (!stamp) return;
  const auto& q = pose.rotation;
  const auto& t = pose.translation;
  PoseSample sample =
      from_t265(*stamp, Eigen::Quaterniond(q.w, q.x, q.y, q.z), Eigen::Vector3d(t.x, t.y, t.z),
                static_cast<std::uint8_t>(std::min(pose.tracker_confidence, 3U)));
  sample.clock = clock_from(domain);
  sink.push(sample);
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
