// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/live/live_rig.hpp"
#include "swiftlet/source/realsense/realsense_rig_private.hpp"
#include "swiftlet/source/rig/rig_options.hpp"

// realsense:[SERIAL[,SERIAL...]][?profile=848x480@30&poses=udp:PORT&rig=FILE...]: D400 cameras and
// a T265, or any other pose source, on one body, live. A camera without a serial is the first
// there.

namespace swiftlet {
namespace {

constexpr std::string_view kRealsenseOptions =
    "profile=WIDTHxHEIGHT@FPS, laser_mw, preset, "
    "poses=udp:PORT|udp:ADDRESS:PORT|unix:PATH|mavlink, "
    "pose_key=FILE, pose_axes=rep103|t265|optical, wait_s";

/// "848x480@30"
bool parse_profile(std::string_view text, RealsenseProfile& out) {
  int* const parts[]{&out.width, &out.height, &out.fps};
  const char ends[]{'x', '@', '\0'};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, *parts[i]);
    if (error != std::errc{} || *parts[i] <= 0) return false;
    if (i == 2) return next == end;
    if (next == end || *next != ends[i]) return false;
    at = next + 1;
  }
  return false;
}

/// "udp:5605"
bool parse_poses(std::string_view text, RealsenseRequest& request) {
  request.poses = parse_pose_address(text);
  return request.poses.has_value();
}

bool apply(std::string_view key, std::string_view value, RealsenseRequest& request) {
  if (key == "profile") return parse_profile(value, request.profile);
  if (key == "poses") return parse_poses(value, request);
  if (key == "pose_key") return !(request.pose_key = value).empty();
  if (key == "pose_axes") {
    const auto axes = body_axes_from(value);
    request.rig.pose_axes = axes.value_or(BodyAxes::kRep103);
    return axes.has_value();
  }
  const auto number = number_within(value, 0.0, 1000.0);
  if (key == "laser_mw" && number) request.profile.laser_mw = static_cast<float>(*number);
  if (key == "preset" && number) request.profile.visual_preset = static_cast<float>(*number);
  if (key == "wait_s" && number) request.timeout = Nanoseconds(std::llround(*number * 1e9));
  if (key == "laser_mw" || key == "preset" || key == "wait_s") return number.has_value();
  return apply_rig_option(key, value, request.rig.rig);
}

/// Gives the cameras of the rig the serial numbers of the address, if it names any.
Status assign_serials(std::string_view place, std::vector<RigCamera>& cameras) {
  if (place.empty()) return Done{};
  const std::vector<std::string> serials = split_list(place);
  if (serials.size() != cameras.size()) {
    return fail(ErrorCode::kUsage, "realsense",
                fmt::format("{} serial numbers for {} camera{}", serials.size(), cameras.size(),
                            cameras.size() == 1 ? "" : "s"),
                "describe the cameras and their mounts in a rig file (docs/rig.md)");
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) cameras[i].stream = serials[i];
  return Done{};
}

/// A rig of live devices; what there was to start them with is kept as long as it runs.
class RealsenseSource final : public FrameSource {
 public:
  RealsenseSource(SourceInfo info, const LiveRig::Options& options)
      : rig_(std::move(info), options) {}
  [[nodiscard]] Status start(RealsenseDevicesPtr devices, const RealsenseRequest& request) {
    auto started = RealsenseRig::start(std::move(devices), request, rig_);
    if (!started) return forward_error(std::move(started));
    devices_ = std::move(*started);
    takes_poses_ = request.poses && request.poses->is_autopilot;
    return Done{};
  }

  Expected<std::optional<Frame>> next() override { return rig_.next(); }
  const SourceInfo& info() const override { return rig_.info(); }
  const FrameTally& tally() const override { return rig_.tally(); }
  const RigStatistics* statistics() const override { return rig_.statistics(); }
  const RigOptions* rig() const override { return rig_.rig(); }
  void stop_when(const std::function<bool()>& is_unwanted) override { rig_.stop_when(is_unwanted); }
  std::vector<RigEvent> take_events() override { return rig_.take_events(); }
  LiveSink* pose_sink() override { return takes_poses_ ? &rig_ : nullptr; }

 private:
  LiveRig rig_;
  bool takes_poses_ = false;
  std::unique_ptr<RealsenseRig> devices_;  // last: it delivers into the rig
};

}  // namespace

Expected<RealsenseRequest> parse_realsense(std::string_view rest) {
  auto address = parse_address(rest, "realsense");
  if (!address) return forward_error(std::move(address));
  auto rig_file = rig_of(*address);
  if (!rig_file) return forward_error(std::move(rig_file));
  RealsenseRequest request;
  request.uri = "realsense:" + std::string(rest);
  request.rig = *rig_file ? **rig_file : intel_t265_d435_rig();
  for (const auto& [key, value] : address->options) {
    if (!apply(key, value, request))
      return bad_option("realsense", key, value,
                        fmt::format("{}, {}", kRealsenseOptions, kRigOptions));
  }
  if (!request.pose_key.empty() && !request.poses) {
    return fail(ErrorCode::kUsage, "realsense", "a key, but no poses from outside",
                "write poses=udp:PORT, too");
  }
  if (request.poses) request.poses->key_file = request.pose_key;
  if (request.poses && !*rig_file) {
    return fail(ErrorCode::kUsage, "realsense",
                "nobody tells where the camera sits on what has the poses",
                "describe the mount in a rig file and give it with --rig (docs/rig.md)");
  }
  if (auto assigned = assign_serials(address->place, request.rig.rig.cameras); !assigned)
    return forward_error(std::move(assigned));
  return request;
}

Expected<FrameSourcePtr> open_realsense(RealsenseDevicesPtr devices,
                                        const RealsenseRequest& request) {
  auto infos = survey_realsense(*devices, request);
  if (!infos) return forward_error(std::move(infos));
  LiveRig::Options options{.rig = request.rig.rig, .queue = {}, .timeout = request.timeout};
  std::vector<RigCamera>& cameras = options.rig.cameras;
  for (std::size_t i = 0; i < cameras.size() && cameras.size() > 1; ++i) {
    if (cameras[i].baseline_m == 0.0) cameras[i].baseline_m = (*infos)[i].baseline_m;
  }
  SourceInfo info{request.uri, request.poses ? "+z" : "+y", std::nullopt, std::nullopt};
  info.intrinsics = {IntrinsicsOrigin::kSdk, {}};
  if (infos->front().baseline_m > 0.0) info.baseline_m = infos->front().baseline_m;
  auto source = std::make_unique<RealsenseSource>(std::move(info), options);
  if (auto started = source->start(std::move(devices), request); !started)
    return forward_error(std::move(started));
  return source;
}

Expected<FrameSourcePtr> open_realsense_source(std::string_view rest) {
  auto request = parse_realsense(rest);
  if (!request) return forward_error(std::move(request));
  auto devices = connected_realsense();
  if (!devices) return forward_error(std::move(devices));
  return open_realsense(std::move(*devices), *request);
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
