// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are the metadata.yaml of a recording of ROS 2.

#include <cstdint>
#include <string_view>

#include "swiftlet/bag/rosbag2/recording_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)swiftlet::files_in_metadata({reinterpret_cast<const char*>(data), size}, "metadata.yaml");
  return 0;
}
