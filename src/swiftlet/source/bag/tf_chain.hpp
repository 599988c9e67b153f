// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/bag/recording_reader.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"

namespace swiftlet {

/// The ties of ROS's tf tree that lead from the vehicle up to its world.
struct TfChain {
  /// Where the child is in the parent.
  struct Tie {
    std::string child, parent;  ///< without the slash that some write before a name
    bool is_static = false;     ///< told once, on a topic of static transforms
    ros::Pose first{};          ///< as it was told first
  };
  std::vector<Tie> ties;  ///< from the vehicle upwards; not all are static

  /// The frame of the vehicle.
  [[nodiscard]] const std::string& body() const { return ties.front().child; }
  /// The frame that its poses are in.
  [[nodiscard]] const std::string& world() const { return ties.back().parent; }
};

/// /tf_static, or that of a namespace.
[[nodiscard]] bool is_static_tf(std::string_view topic);
/// Whether a topic's transforms are meant: all but those of other tf topics than `topics.pose`.
[[nodiscard]] bool is_wanted_tf(const BagConnection& connection, const BagTopics& topics);

/// Looks a recording through, its first 200 MB or until it is found, for the chain from
/// `topics.body_frame` up to `topics.world_frame`. Without a world, it ends at the root. Without a
/// body, the vehicle is what moves lowest above `topics.camera_frame`. Errors: those of
/// RecordingReader; kNotFound and kUsage, naming the frames there are.
[[nodiscard]] Expected<TfChain> find_tf_chain(RecordingReader& reader, const BagTopics& topics);

}  // namespace swiftlet
