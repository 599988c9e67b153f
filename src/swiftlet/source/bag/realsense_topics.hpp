// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/base/time.hpp"

namespace swiftlet {

// Names in the recordings of the RealSense SDK (file versions 3 and 4, SDK 2.13 to 2.57). One
// device a file; topics are /device_0/sensor_N/STREAM_I/..., options /device_0/sensor_N/option/...

/// The stream that a topic is the data of, as in "/device_0/sensor_0/Depth_0"; nullopt for others.
[[nodiscard]] std::optional<std::string> depth_stream_of(std::string_view topic);
[[nodiscard]] std::optional<std::string> pose_stream_of(std::string_view topic);

/// Whether a topic carries the value of an option of the sensor of `stream`; older SDKs write its
/// words apart by blanks, newer ones by '_'. `option` in the newer way, as in "Depth_Units".
[[nodiscard]] bool is_option_of(std::string_view topic, std::string_view stream,
                                std::string_view option);

/// "Global Time", "System Time", "Hardware Clock".
[[nodiscard]] ClockDomain clock_from_name(std::string_view name);

/// A time in milliseconds as the SDK writes it: decimal, or hexadecimal before 2.22.
[[nodiscard]] std::optional<Stamp> stamp_from_milliseconds(std::string_view text);
/// nullopt for what is no time: NaN, or beyond the range of a Stamp.
[[nodiscard]] std::optional<Stamp> stamp_from_milliseconds(double ms);

}  // namespace swiftlet
