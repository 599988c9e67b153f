// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <librealsense2/rs.hpp>
#include <memory>
#include <vector>

#include "swiftlet/source/realsense/realsense.hpp"

namespace swiftlet {

/// A connected device, and what it said of itself when it was listed.
struct RealsenseDevice {
  rs2::device device;
  DeviceInfo facts;
};

/// The devices that there are now. Thread safety: list() by one thread at a time.
class RealsenseDevices {
 public:
  using WasRemoved = std::function<bool(const rs2::device&)>;

  virtual ~RealsenseDevices() = default;
  /// Devices that go away while they are asked are left out; never throws.
  [[nodiscard]] virtual std::vector<RealsenseDevice> list() = 0;
  /// Calls `tell`, from a thread of the SDK, each time that devices have been removed; an empty
  /// function stops that.
  virtual void on_removed(std::function<void(const WasRemoved&)> tell) = 0;
};
using RealsenseDevicesPtr = std::shared_ptr<RealsenseDevices>;

/// What is connected to this computer. Errors: kIo with the SDK's words.
[[nodiscard]] Expected<RealsenseDevicesPtr> connected_realsense();

/// What a device tells of itself. Throws what the SDK throws.
[[nodiscard]] DeviceInfo facts_of(const rs2::device& device);

}  // namespace swiftlet
