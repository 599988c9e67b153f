// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// A line of depth.txt: `timestamp file`.
struct TumImage {
  Stamp stamp;
  std::filesystem::path file;  ///< as listed, relative to the folder
};

/// A line of groundtruth.txt: `timestamp tx ty tz qx qy qz qw` (metres, scalar last), the optical
/// frame of the camera in the motion-capture world.
/// Nothing in it is trusted: it may be NaN, or no rotation.
struct TumPose {
  Stamp stamp;
  Eigen::Quaterniond R_native_camera;
  Eigen::Vector3d t_native_camera_m;
};

/// Read a list file, sorted by time; equal times keep the order of the file.
/// Errors: kNotFound, kIo; kCorruptInput naming file and line where a line is malformed, or if
/// there is no line at all. Values of a pose may be NaN or infinite: the gates count them.
[[nodiscard]] Expected<std::vector<TumImage>> read_tum_images(const std::filesystem::path& list);
[[nodiscard]] Expected<std::vector<TumPose>> read_tum_poses(const std::filesystem::path& list);

/// Adds an offset to every stamp; those at the ends of time stay there.
void shift_times(std::vector<TumImage>& images, Nanoseconds offset);

/// The words of an image list that name what it was made from, as in "# file:
/// 'rgbd_dataset_freiburg1_xyz.bag'"; empty if it does not say. Errors are told when it is read.
[[nodiscard]] std::string tum_origin(const std::filesystem::path& list);

}  // namespace swiftlet
