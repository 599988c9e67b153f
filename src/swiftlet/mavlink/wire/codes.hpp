// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

// Numbers that fields of messages hold. Source: the public dialects minimal.xml and common.xml.

namespace swiftlet::mavlink::codes {

// MAV_TYPE
inline constexpr std::uint8_t kTypeOnboardController = 18, kTypeGcs = 6;
// MAV_AUTOPILOT
inline constexpr std::uint8_t kAutopilotArduPilot = 3, kAutopilotNone = 8, kAutopilotPx4 = 12;
// MAV_STATE
inline constexpr std::uint8_t kStateStandby = 3, kStateActive = 4, kStateCritical = 5;
// MAV_MODE_FLAG
inline constexpr std::uint8_t kModeIsArmed = 128;
// MAV_COMPONENT
inline constexpr std::uint8_t kComponentAutopilot = 1, kComponentObstacleAvoidance = 196,
                              kComponentVisualInertialOdometry = 197;
// MAV_FRAME
inline constexpr std::uint8_t kFrameLocalNed = 1, kFrameBodyFrd = 12, kFrameLocalFrd = 20;
// MAV_DISTANCE_SENSOR
inline constexpr std::uint8_t kSensorUnknown = 4;
// MAV_ESTIMATOR_TYPE
inline constexpr std::uint8_t kEstimatorVio = 3;
// MAV_SEVERITY
inline constexpr std::uint8_t kCritical = 2, kWarning = 4, kInfo = 6;
// MAV_CMD
inline constexpr std::uint16_t kSetMessageInterval = 511;

}  // namespace swiftlet::mavlink::codes
