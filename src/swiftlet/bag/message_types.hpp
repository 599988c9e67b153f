// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>

namespace swiftlet {

/// The name of a type without the folder that ROS 2 put between: "sensor_msgs/msg/Image" is
/// "sensor_msgs/Image".
[[nodiscard]] inline std::string plain_type_name(std::string_view name) {
  constexpr std::string_view kFolder = "/msg/";
  const std::size_t at = name.find(kFolder);
  if (at == std::string_view::npos) return std::string(name);
  return std::string(name.substr(0, at + 1)) + std::string(name.substr(at + kFolder.size()));
}

}  // namespace swiftlet
