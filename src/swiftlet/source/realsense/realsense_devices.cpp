// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "swiftlet/source/realsense/realsense_devices_private.hpp"

namespace swiftlet {
namespace {

/// By its name, as the list of them has grown with the SDK's versions.
std::string info_of(const rs2::device& device, std::string_view name) {
  for (int i = 0; i < RS2_CAMERA_INFO_COUNT; ++i) {
    const auto info = static_cast<rs2_camera_info>(i);
    if (name == rs2_camera_info_to_string(info) && device.supports(info))
      return device.get_info(info);
  }
  return {};
}

class ConnectedDevices final : public RealsenseDevices {
 public:
  std::vector<RealsenseDevice> list() override {
    std::vector<RealsenseDevice> found;
    try {
      const rs2::device_list devices = context_.query_devices();
      // NOLINTNEXTLINE(modernize-loop-convert): taking a device out of the list may throw, too
      for (std::uint32_t i = 0; i < devices.size(); ++i) {
        try {
          const rs2::device device = devices[i];
          found.push_back({device, facts_of(device)});
        } catch (const rs2::error&) {
          continue;  // it has gone while it was asked: it is not there
        }
      }
    } catch (const rs2::error&) {
      return found;
    }
    return found;
  }

  void on_removed(std::function<void(const WasRemoved&)> tell) override {
    context_.set_devices_changed_callback([tell = std::move(tell)](rs2::event_information& event) {
      if (tell) tell([&](const rs2::device& device) { return event.was_removed(device); });
    });
  }

 private:
  rs2::context context_;
};

/// "2.13.0" of 21300
std::string version_text(int version) {
  return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace

DeviceInfo facts_of(const rs2::device& device) {
  DeviceInfo facts{info_of(device, "Name"),
                   info_of(device, "Serial Number"),
                   info_of(device, "Firmware Version"),
                   info_of(device, "Recommended Firmware Version"),
                   info_of(device, "Usb Type Descriptor"),
                   {},
                   false};
  for (const rs2::sensor& sensor : device.query_sensors()) {
    for (const rs2::stream_profile& profile : sensor.get_stream_profiles()) {
      facts.has_poses = facts.has_poses || profile.stream_type() == RS2_STREAM_POSE;
      const auto video = profile.as<rs2::video_stream_profile>();
      if (!video || profile.stream_type() != RS2_STREAM_DEPTH) continue;
      facts.depth_profiles.push_back(
          fmt::format("{}x{}@{}", video.width(), video.height(), profile.fps()));
    }
  }
  return facts;
}

Expected<RealsenseDevicesPtr> connected_realsense() {
  try {
    return std::make_shared<ConnectedDevices>();
  } catch (const std::exception& error) {
    return fail(ErrorCode::kIo, "realsense", error.what());
  }
}

Expected<RealsenseSystem> examine_realsense() {
  auto devices = connected_realsense();
  if (!devices) return forward_error(std::move(devices));
  RealsenseSystem system;
  rs2_error* error = nullptr;
  const int version = rs2_get_api_version(&error);
  rs2_free_error(error);
  system.sdk = version_text(version);
  system.can_know_t265 = version >= 21700 && version <= 25399;
  for (RealsenseDevice& device : (*devices)->list()) system.devices.push_back(device.facts);
  return system;
}

}  // namespace swiftlet

#else

#include "swiftlet/source/realsense/realsense.hpp"

namespace swiftlet {
namespace {

tl::unexpected<Error> no_sdk() {
  return fail(
      ErrorCode::kUnsupported, "realsense", "this build of Swiftlet has no RealSense SDK",
      "install the SDK and configure with -DSWIFTLET_WITH_REALSENSE=ON (docs/realsense.md)");
}

}  // namespace

Expected<RealsenseSystem> examine_realsense() { return no_sdk(); }

Expected<LiveRecordingPtr> record_realsense(std::string_view /*rest*/,
                                            const std::filesystem::path& /*folder*/) {
  return no_sdk();
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
