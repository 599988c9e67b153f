// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/source/rig/mounts.hpp"
#include "swiftlet/source/streams.hpp"

namespace swiftlet {

/// What to take from a bag; what is empty is found.
struct BagTopics {
  std::string depth{};       ///< topic of the depth images
  std::string info{};        ///< topic of their sensor_msgs/CameraInfo; default: camera_info beside
  std::string pose{};        ///< topic of the poses
  std::string body_frame{};  ///< the vehicle, where a tf topic holds many frames
  std::string world_frame{};   ///< what its poses shall be in; default: the root of tf
  std::string camera_frame{};  ///< of the depth images, which tells the vehicle where nobody does
  BodyAxes pose_axes = BodyAxes::kRep103;  ///< of poses of ROS bags
  double depth_unit_m = 0.001;             ///< of 16-bit images of ROS bags
};

/// The depth images of a bag, and what is known before the first.
struct BagDepth {
  DepthStreamPtr stream;
  std::string topic;
  std::string frame_id;  ///< of ROS bags: the optical frame
  PinholeIntrinsics intrinsics;
  std::optional<double> baseline_m;
  std::string told{};  ///< what was chosen, in words
};

/// The poses of a bag.
struct BagPoses {
  PoseStreamPtr stream;
  std::string topic;
  std::string child_frame;  ///< of ROS bags: the frame that moves; may be empty
  bool is_t265 = false;     ///< recorded by the SDK: native up axis is +y
  std::string told{};       ///< what was chosen, in words
};

/// Opens the depth images of a recording of the RealSense SDK or of ROS; poses also of a text file
/// with lines as in TUM's trajectories. What a file is, its content tells and not its name.
/// Errors: those of RecordingReader; kNotFound naming the topics there are; those of the
/// intrinsics.
[[nodiscard]] Expected<BagDepth> open_bag_depth(const std::filesystem::path& path,
                                                const BagTopics& topics);
[[nodiscard]] Expected<BagPoses> open_bag_poses(const std::filesystem::path& path,
                                                const BagTopics& topics);

/// The mount that the /tf_static messages of a ROS bag, or those of a namespace, tell:
/// `camera_frame` in `body_frame`. Errors: those of RecordingReader; kNotFound, naming the frames
/// there are, if there is no chain between the two near the beginning of the file.
[[nodiscard]] Expected<Transform<Body, Camera>> mount_from_tf(const std::filesystem::path& path,
                                                              const std::string& body_frame,
                                                              const std::string& camera_frame);

}  // namespace swiftlet
