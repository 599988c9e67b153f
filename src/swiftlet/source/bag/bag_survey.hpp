// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/bag/recording_reader.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"

namespace swiftlet {

/// A topic of a recording of ROS that may hold depth.
struct DepthCandidate {
  std::string topic;
  std::string type;      ///< of its messages, see is_depth_type()
  std::string encoding;  ///< of its pixels
  std::string frame_id;
  int width = 0, height = 0;
  std::size_t images = 0;                   ///< that were looked at
  Stamp first, last;                        ///< when they were recorded
  int evidence = 0;                         ///< that it is depth; below 1 it is none
  std::optional<ros::CameraInfo> camera{};  ///< as far as the messages themselves tell

  /// "/camera/depth/image_raw (16UC1, 640 x 480, 30.0 Hz)"
  [[nodiscard]] std::string text() const;
};

/// The candidates of a bag, in the order of the file; only `wanted` if it is not empty. Reads on
/// until one is plainly depth and some more, so that a better one beside it is seen; a fault of
/// the file behind a candidate is left to whoever reads on. Errors: those of RecordingReader.
[[nodiscard]] Expected<std::vector<DepthCandidate>> survey_depth(RecordingReader& reader,
                                                                 std::string_view wanted);

/// The one that is depth by the evidence of its encoding, its name and its pixels.
/// Errors: kNotFound naming what there is and what to do; kUsage if two have the same claim.
[[nodiscard]] Expected<DepthCandidate> choose_depth(const RecordingReader& reader,
                                                    const std::vector<DepthCandidate>& candidates,
                                                    std::string_view wanted);

}  // namespace swiftlet
