// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/source/rig_event.hpp"

// What can be asked of live RealSense cameras beside the source `realsense:`. In a build without
// the SDK every answer is kUnsupported.

namespace swiftlet {

/// What their addresses begin with.
inline constexpr std::string_view kRealsenseKind = "realsense:";
/// An address as a command takes it: "realsense" alone means whatever is connected.
[[nodiscard]] inline std::string realsense_address(const std::string& text) {
  return text == "realsense" ? std::string(kRealsenseKind) : text;
}

/// What a connected device tells of itself; empty where it does not.
struct DeviceInfo {
  std::string name;
  std::string serial;
  std::string firmware;
  std::string recommended_firmware;         ///< by the SDK
  std::string usb;                          ///< "3.2", "2.1", ...
  std::vector<std::string> depth_profiles;  ///< as in "848x480@30"
  bool has_poses = false;

  [[nodiscard]] bool has_depth() const { return !depth_profiles.empty(); }
};

/// The SDK and what is connected.
struct RealsenseSystem {
  std::string sdk;             ///< its version, as in "2.53.1"
  bool can_know_t265 = false;  ///< SDK 2.53.1 is the last that does; 2.13 of npm is built without
  std::vector<DeviceInfo> devices;
};

/// Errors: kUnsupported without the SDK, kIo with the SDK's words.
[[nodiscard]] Expected<RealsenseSystem> examine_realsense();

/// The SDK's own recordings, one file a device, while it lives.
class LiveRecording {
 public:
  struct Stream {
    std::string name;            ///< as in "camera 'front'"
    std::filesystem::path file;  ///< the one that is written now; empty: not started yet
    std::size_t samples;
  };
  virtual ~LiveRecording() = default;
  [[nodiscard]] virtual std::vector<Stream> streams() const = 0;
  [[nodiscard]] virtual std::vector<RigEvent> take_events() = 0;
};
using LiveRecordingPtr = std::unique_ptr<LiveRecording>;

/// Records what `realsense:REST` would map into a folder: depth_SERIAL.bag, t265_SERIAL.bag, and
/// poses.txt if they come over UDP. A device that was unplugged goes on in a file of its own
/// (depth_SERIAL_2.bag). The destructor closes the files.
/// Errors: kUsage if one of the files exists; kUnsupported, and those of the source.
[[nodiscard]] Expected<LiveRecordingPtr> record_realsense(std::string_view rest,
                                                          const std::filesystem::path& folder);

}  // namespace swiftlet
