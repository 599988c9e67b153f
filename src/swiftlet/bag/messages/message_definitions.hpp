// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>

namespace swiftlet {

/// The definition of a message of ROS 2 ("ros2msg") as MCAP and Foxglove want it: its own text,
/// then that of each type in it. REQUIRES: a type of the table in the .cpp, as in
/// "sensor_msgs/Image".
[[nodiscard]] std::string message_definition(std::string_view type);

}  // namespace swiftlet
