// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet {

/// A camera of an OpenLORIS-Scene folder.
struct OpenLorisCamera {
  PinholeIntrinsics intrinsics;
  Transform<Body, Camera> T_body_camera;  ///< body = base_link
};

/// Reads a camera, as in "d400_depth_optical_frame", from sensors.yaml and trans_matrix.yaml, which
/// are files of OpenCV's FileStorage. Intrinsics stand as fx, cx, fy, cy, not as usual; transforms
/// are T_parent_child, chained up to base_link.
/// Errors: kNotFound, kIo; kCorruptInput naming the file and what is wrong; kUnsupported if the
/// images have lens distortion.
[[nodiscard]] Expected<OpenLorisCamera> read_openloris_camera(const std::filesystem::path& folder,
                                                              const std::string& frame);

}  // namespace swiftlet
