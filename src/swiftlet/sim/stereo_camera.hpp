// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <vector>

#include "swiftlet/base/image.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/sim/ray_caster.hpp"

namespace swiftlet::sim {

/// A stereo depth camera (D435) in a ray-cast world.
///
/// Depth becomes disparity d = f B / z; there it gets Gaussian noise and steps of 1/32 px, and back
/// it becomes millimetres: hence sigma_z = z^2 s / (f B) (method 3). A pixel has no reading (0) if
/// the right imager, one baseline to the right, cannot see its point (shadows left of near
/// objects), if its surface is blank or grazing, or outside the range. Pixels at depth edges may
/// fall between fore- and background. A camera with a barrel measures too small a disparity away
/// from the optical axis.
/// Repeatable: noise depends on (seed, frame, pixel) alone, not on the number of threads.
/// Thread safety: one capture at a time.
class StereoCamera {
 public:
  static constexpr unsigned kThreads = 2;

  [[nodiscard]] static Expected<StereoCamera> create(const StereoOptions& options,
                                                     std::uint64_t seed,
                                                     unsigned threads = kThreads);

  /// What the camera reports from a pose: uint16 millimetres, 0 = no reading.
  [[nodiscard]] DepthImage capture(const RayCaster& world,
                                   const Transform<World, Camera>& T_world_camera,
                                   std::uint64_t frame_number);

  [[nodiscard]] const PinholeIntrinsics& intrinsics() const { return intrinsics_; }

 private:
  StereoCamera(const StereoOptions& options, const PinholeIntrinsics& intrinsics,
               std::uint64_t seed, unsigned threads);

  /// What the left imager sees along one row, and what the right one does not.
  struct RowBuffers {
    std::vector<Eigen::Vector3f> rays, points;
    std::vector<Hit> hits;
    std::vector<std::uint8_t> is_seen;
  };
  struct View;  // the pose, unpacked for the inner loops

  void see_row(const RayCaster& world, const View& view, int v, RowBuffers& row);
  void report_row(std::uint64_t frame_number, int v, DepthImage& depth) const;
  [[nodiscard]] bool is_matched(const Hit& hit, std::uint64_t frame_number, int u, int v) const;
  [[nodiscard]] float mixed_disparity(int u, int v, float draw, float share) const;
  [[nodiscard]] float bend_px(int u, int v) const;
  [[nodiscard]] std::uint16_t reading_mm(float disparity_px) const;

  StereoOptions options_;
  PinholeIntrinsics intrinsics_;
  std::uint64_t seed_;
  unsigned threads_;
  Image<float> disparity_px_;        // of the first surface; 0 where there is none
  Image<std::uint8_t> is_matched_;   // whether the two imagers agree on it
  std::vector<RowBuffers> buffers_;  // one per thread
};

}  // namespace swiftlet::sim
