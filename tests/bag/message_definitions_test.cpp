// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/messages/message_definitions.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace swiftlet {
namespace {

TEST(MessageDefinition, has_every_type_that_it_names) {
  for (const char* type : {"sensor_msgs/PointCloud2", "nav_msgs/Odometry", "tf2_msgs/TFMessage",
                           "sensor_msgs/Image", "sensor_msgs/CameraInfo", "nav_msgs/Path"}) {
    std::istringstream text(message_definition(type));
    std::set<std::string> named, defined;
    for (std::string line; std::getline(text, line);) {
      const std::string word = line.substr(0, line.find_first_of(" ["));
      if (line.starts_with("MSG: ")) defined.insert(line.substr(5));
      if (word.find('/') != std::string::npos) named.insert(word);
    }
    EXPECT_TRUE(named.contains("builtin_interfaces/Time")) << type;
    for (const std::string& name : named)
      EXPECT_TRUE(defined.contains(name)) << type << " " << name;
  }
}

}  // namespace
}  // namespace swiftlet
