// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <algorithm>
#include <cstring>
#include <utility>

#include "swiftlet/source/bag/realsense_topics.hpp"
#include "swiftlet/source/realsense/realsense_driver_private.hpp"
#include "swiftlet/source/rig/t265_axes.hpp"

// Frames of the SDK, in our types.

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

void take_depth(const rs2::frame& frame, const RealsenseDepthInfo& info, std::uint8_t camera,
                LiveSink& sink) {
  // A frame that cannot be read is one less; the SDK must not see an exception in its callback.
  (void)with_sdk([&]() -> Status {
    const auto video = frame.as<rs2::video_frame>();
    const auto stamp = stamp_from_milliseconds(frame.get_timestamp() - exposure_lag_ms(frame));
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
  const auto stamp = stamp_from_milliseconds(timestamp_ms);
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
