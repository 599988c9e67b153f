// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swiftlet/source/streams.hpp"

namespace swiftlet {

/// How each image of a depth stream of a RealSense recording was taken, from its metadata ("Actual
/// Exposure", "Frame Laser Power") or, for the laser, from the option of the sensor before it.
/// Empty for bags that the SDK did not record. `data_topic` as in
/// "/device_0/sensor_0/Depth_0/image/data". Errors: those of RecordingReader.
[[nodiscard]] Expected<std::vector<CaptureSettings>> read_realsense_settings(
    const std::filesystem::path& path, const std::string& data_topic);

}  // namespace swiftlet
