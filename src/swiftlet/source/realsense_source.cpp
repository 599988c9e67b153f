// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/live_rig.hpp"
#include "swiftlet/source/realsense_driver_private.hpp"
#include "swiftlet/source/rig_options.hpp"

// realsense:[SERIAL][?profile=848x480@30&laser_mw=150&preset=3&rig=FILE...]: a D400 camera and a
// T265 on one body, live. Without a serial the first camera with depth is taken.

namespace swiftlet {
namespace {

constexpr std::string_view kOwnOptions = "profile=WIDTHxHEIGHT@FPS, laser_mw, preset";
constexpr auto kRetry = std::chrono::milliseconds(500);

struct Request {
  std::string serial;
  RealsenseProfile profile;
  RigOptions rig;
};

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

bool apply(std::string_view key, std::string_view value, Request& request) {
  if (key == "profile") return parse_profile(value, request.profile);
  const auto number = number_within(value, 0.0, 1000.0);
  if (key == "laser_mw" && number) request.profile.laser_mw = static_cast<float>(*number);
  if (key == "preset" && number) request.profile.visual_preset = static_cast<float>(*number);
  if (key == "laser_mw" || key == "preset") return number.has_value();
  return apply_rig_option(key, value, request.rig);
}

bool has_stream(const rs2::device& device, rs2_stream stream) {
  for (const rs2::sensor& sensor : device.query_sensors()) {
    for (const rs2::stream_profile& profile : sensor.get_stream_profiles()) {
      if (profile.stream_type() == stream) return true;
    }
  }
  return false;
}

std::string serial_of(const rs2::device& device) {
  return device.supports(RS2_CAMERA_INFO_SERIAL_NUMBER)
             ? device.get_info(RS2_CAMERA_INFO_SERIAL_NUMBER)
             : "";
}

/// The first device that has a stream and, if it is given, a serial number. The SDK's exceptions
/// mean that a device has gone while it was asked: it is not there.
std::optional<rs2::device> find_device(const rs2::context& context, rs2_stream stream,
                                       const std::string& serial = {}) {
  try {
    for (const rs2::device& device : context.query_devices()) {
      if (has_stream(device, stream) && (serial.empty() || serial_of(device) == serial))
        return device;
    }
  } catch (const rs2::error&) {
    return std::nullopt;
  }
  return std::nullopt;
}

/// Both devices of the rig. A thread of its own starts what was unplugged again when it is back.
class RealsenseSource final : public FrameSource {
 public:
  RealsenseSource(rs2::context context, SourceInfo info, const Request& request)
      : context_(std::move(context)),
        request_(request),
        rig_(std::move(info), {.rig = request.rig, .queue = {}}) {
    context_.set_devices_changed_callback([this](rs2::event_information& event) {
      const std::lock_guard lock(mutex_);
      if (depth_device_ && event.was_removed(*depth_device_)) is_depth_lost_ = true;
      if (pose_device_ && event.was_removed(*pose_device_)) is_pose_lost_ = true;
    });
    keeper_ = std::thread([this] { keep(); });
  }
  RealsenseSource(const RealsenseSource&) = delete;
  RealsenseSource& operator=(const RealsenseSource&) = delete;
  ~RealsenseSource() override {
    context_.set_devices_changed_callback([](rs2::event_information&) {});  // not into what goes
    {
      const std::lock_guard lock(mutex_);
      is_stopped_ = true;
    }
    stopped_.notify_all();
    keeper_.join();
    depth_.reset();
    poses_.reset();
  }

  Expected<std::optional<Frame>> next() override { return rig_.next(); }
  const SourceInfo& info() const override { return rig_.info(); }
  const FrameTally& tally() const override { return rig_.tally(); }

 private:
  void keep() {
    std::unique_lock lock(mutex_);
    while (!is_stopped_) {
      const bool drop_depth = std::exchange(is_depth_lost_, false);
      const bool drop_poses = std::exchange(is_pose_lost_, false);
      lock.unlock();  // the SDK may call back while it starts and stops
      if (drop_depth) depth_.reset();
      if (drop_poses) poses_.reset();
      if (depth_ == nullptr) connect_depth();
      if (poses_ == nullptr) connect_poses();
      lock.lock();
      stopped_.wait_for(lock, kRetry, [this] { return is_stopped_; });
    }
  }

  void connect_depth() {
    const auto device = find_device(context_, RS2_STREAM_DEPTH, request_.serial);
    if (!device) return;
    const auto prepared = prepare_depth(*device, request_.profile);
    if (!prepared) return;
    if (auto started = start_depth(*prepared, 0, rig_)) {
      depth_ = std::move(*started);
      const std::lock_guard lock(mutex_);
      depth_device_ = device;
    }
  }

  void connect_poses() {
    const auto device = find_device(context_, RS2_STREAM_POSE);
    if (!device) return;
    if (pose_device_) rig_.start_poses_anew();  // a T265 begins a new world when it starts
    if (auto started = start_poses(*device, rig_)) {
      poses_ = std::move(*started);
      const std::lock_guard lock(mutex_);
      pose_device_ = device;
    }
  }

  rs2::context context_;
  Request request_;
  LiveRig rig_;
  RealsenseStreamPtr depth_, poses_;  // the keeper's

  std::mutex mutex_;  // of all that follows
  std::condition_variable stopped_;
  std::optional<rs2::device> depth_device_, pose_device_;
  bool is_depth_lost_ = false;
  bool is_pose_lost_ = false;
  bool is_stopped_ = false;

  std::thread keeper_;
};

Expected<Request> parse_request(std::string_view rest) {
  auto address = parse_address(rest, "realsense");
  if (!address) return forward_error(std::move(address));
  auto rig_file = rig_of(*address);
  if (!rig_file) return forward_error(std::move(rig_file));
  Request request{address->place, {}, (*rig_file ? **rig_file : intel_t265_d435_rig()).rig};
  for (const auto& [key, value] : address->options) {
    if (!apply(key, value, request))
      return bad_option("realsense", key, value, fmt::format("{}, {}", kOwnOptions, kRigOptions));
  }
  if (request.rig.cameras.size() != 1)
    return fail(ErrorCode::kUnsupported, "realsense", "a live rig has one depth camera so far",
                "record the others and map the recordings");
  return request;
}

}  // namespace

Expected<FrameSourcePtr> open_realsense_source(std::string_view rest) {
  auto request = parse_request(rest);
  if (!request) return forward_error(std::move(request));
  try {
    rs2::context context;
    const auto depth = find_device(context, RS2_STREAM_DEPTH, request->serial);
    if (!depth) {
      return fail(ErrorCode::kNotFound, "realsense:" + request->serial,
                  "no such RealSense camera with depth is connected",
                  "check the cable, the udev rules of the SDK, and the serial number");
    }
    if (!find_device(context, RS2_STREAM_POSE)) {
      return fail(ErrorCode::kNotFound, "realsense:", "no T265 is connected",
                  "its poses are needed; SDK 2.53.1 is the last that knows it");
    }
    auto prepared = prepare_depth(*depth, request->profile);
    if (!prepared) return forward_error(std::move(prepared));
    SourceInfo info{"realsense:" + std::string(rest), "+y", std::nullopt, std::nullopt};
    if (prepared->info.baseline_m > 0.0) info.baseline_m = prepared->info.baseline_m;
    return std::make_unique<RealsenseSource>(std::move(context), std::move(info), *request);
  } catch (const rs2::error& error) {
    return fail(ErrorCode::kIo, "realsense", error.what());
  }
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
