// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "swiftlet/integrate/projective/cube_view.hpp"

namespace swiftlet {

/// A point on a face of a voxel, from the face's middle.
struct FaceSample {
  Float3 to;      ///< [m, camera axes]
  float along_j;  ///< [m] along the next of the world's axes after the one across the face
  float along_k;  ///< and along the one after that
};

/// Where the image of a voxel is looked at: points on those of its faces that the camera sees, so
/// many on each as its share of the image is large. From a point, an axis-aligned cube shows at
/// most three faces.
class FaceSamples {
 public:
  static constexpr int kMost = 48;  ///< on all faces together

  /// Of the face across the world's axis i.
  [[nodiscard]] std::span<const FaceSample> on_face(std::size_t i) const {
    return {&places_[first_[i]], first_[i + 1] - first_[i]};
  }

  /// At least `count` samples for voxels about p_world [m, relative to the camera]. Each frame puts
  /// them elsewhere, so that what falls between them in one frame is seen in another.
  void spread(int count, const Float3& p_world, float voxel_m,
              const std::array<Float3, 3>& world_axis, std::uint64_t frame_number);

 private:
  std::array<std::size_t, 4> first_{};
  std::array<FaceSample, kMost + 3> places_;
};

}  // namespace swiftlet
