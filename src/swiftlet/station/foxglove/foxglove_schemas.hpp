// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>

namespace swiftlet::station {

/// The definition of a message as Foxglove wants it: its own text, then that of each type in it.
/// REQUIRES: a type of the table in the .cpp, as in "foxglove_msgs/PointCloud".
[[nodiscard]] std::string foxglove_schema(std::string_view type);

}  // namespace swiftlet::station
