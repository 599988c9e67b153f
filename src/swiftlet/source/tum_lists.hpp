// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/source/world_axes.hpp"

namespace swiftlet {

/// A line of depth.txt: `timestamp file`.
struct TumImage {
  Stamp stamp;
  std::filesystem::path file;  ///< as listed, relative to the folder
};

/// A line of groundtruth.txt: `timestamp tx ty tz qx qy qz qw` (metres, scalar last), the optical
/// frame of the camera in the motion-capture world.
struct TumPose {
  Stamp stamp;
  Transform<NativeWorld, Camera> T_native_camera;
};

/// Read a list file, sorted by time; equal times keep the order of the file.
/// Errors: kNotFound, kIo; kCorruptInput naming file and line where a line is malformed or a pose
/// is not finite or not a unit quaternion, or if there is no line at all.
[[nodiscard]] Expected<std::vector<TumImage>> read_tum_images(const std::filesystem::path& list);
[[nodiscard]] Expected<std::vector<TumPose>> read_tum_poses(const std::filesystem::path& list);

}  // namespace swiftlet
