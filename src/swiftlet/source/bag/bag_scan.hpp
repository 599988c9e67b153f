// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"

namespace swiftlet {

/// Reads a bag from its beginning until visit(message) returns true; the result tells whether it
/// did. Errors: those of RecordingReader.
template <class Visit>
[[nodiscard]] Expected<bool> scan_bag(RecordingReader& reader, Visit&& visit) {
  while (true) {
    auto message = reader.next();
    if (!message) return forward_error(std::move(message));
    if (!*message) return false;
    if (visit(**message)) return true;
  }
}

/// The next message. A fault of the file waits in `fault` while something from before it is
/// pending: the stream seems to end, gives that, and then tells the fault.
[[nodiscard]] inline Expected<std::optional<BagMessage>> read_after(RecordingReader& reader,
                                                                    std::optional<Error>& fault,
                                                                    bool is_pending) {
  if (fault && !is_pending) return tl::make_unexpected(*std::exchange(fault, std::nullopt));
  auto message = reader.next();
  if (message || !is_pending) return message;
  fault = std::move(message.error());
  return std::nullopt;
}

/// The error for a bag without what was asked for; names what there is instead, and what is nearest
/// to what the user has typed.
[[nodiscard]] tl::unexpected<Error> no_such_topic(const RecordingReader& reader,
                                                  std::string_view what, std::string_view remedy,
                                                  std::string_view typed = {});

/// A name of ROS without the slash that some write before it: "/base_link" is base_link.
[[nodiscard]] inline std::string_view plain_name(std::string_view name) {
  return name.substr(name.starts_with('/') ? 1 : 0);
}
[[nodiscard]] inline bool is_same_name(std::string_view a, std::string_view b) {
  return plain_name(a) == plain_name(b);
}
/// "did you mean base_link? It has base_link, camera_link"
[[nodiscard]] std::string names_instead(std::string_view typed,
                                        const std::vector<std::string>& known);

// The two kinds of recordings, the SDK's and those of ROS, each behind the same two doors. nullopt:
// it is one of the other kind.
[[nodiscard]] Expected<std::optional<BagDepth>> open_realsense_depth(
    const std::filesystem::path& path);
[[nodiscard]] Expected<std::optional<BagPoses>> open_realsense_poses(
    const std::filesystem::path& path);
/// Poses as lines of text, in the order of the file (parse_pose_line()). The whole file is read.
/// Errors: kNotFound, kIo; kCorruptInput naming file and line.
[[nodiscard]] Expected<BagPoses> open_text_poses(const std::filesystem::path& path,
                                                 const BagTopics& topics);
[[nodiscard]] Expected<BagDepth> open_ros_depth(const std::filesystem::path& path,
                                                const BagTopics& topics);
[[nodiscard]] Expected<BagPoses> open_ros_poses(const std::filesystem::path& path,
                                                const BagTopics& topics);
/// Poses through the whole tf tree, interpolated. Errors: those of find_tf_chain().
[[nodiscard]] Expected<BagPoses> open_tf_poses(const std::filesystem::path& path,
                                               const BagTopics& topics);

}  // namespace swiftlet
