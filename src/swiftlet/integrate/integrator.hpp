// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/registry.hpp"
#include "swiftlet/condition/conditioned_depth.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/integrate/image/depth_range_pyramid.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// Everything that the integrators can be told.
struct IntegrateOptions {
  std::string integrator = "projective";
  std::string fusion = "sharp";  ///< what happens to a frame before and after; see MapperConfig
  std::string ray_method = "voxel_traversal";
  double logodds_per_step = 0.04;  ///< one step of a cell's byte, so +-127 steps are +-5.08
  int threads = 1;                 ///< of the projective integrator; same map bits for any number
  double decay_s = 0.0;            ///< see OccupancyDecay; 0: never
  double max_frame_ms = 0.0;  ///< far blocks wait for the next frame once this is over; 0: never
};

/// One conditioned frame.
struct DepthView {
  const ConditionedDepth& depth;
  const DepthRangePyramid& pyramid;     ///< of depth.raw
  const PinholeIntrinsics& intrinsics;  ///< of the full image
  const Transform<World, Camera>& T_world_camera;
  std::uint64_t frame_number;  ///< seeds the rounding; counts frames of the map from 0
};

/// What one frame did to the map.
struct IntegrationTally {
  std::size_t readings = 0;     ///< valid pixels that were fused
  std::size_t cells = 0;        ///< cells that received evidence; surely free ones may be left out
  std::size_t blocks = 0;       ///< blocks that hold them
  std::size_t blocks_left = 0;  ///< in view, but left for the next frame by max_frame_ms
};

/// Turns the evidence of a whole frame into belief.
/// Law: a frame gives the same map bits whatever the order of its pixels and the number of threads.
class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual IntegrationTally integrate(const DepthView& view, const StereoSensor& sensor,
                                     RollingMap& map) = 0;
  /// Scratch memory [bytes].
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
};

using MakeIntegrator = Expected<std::unique_ptr<Integrator>> (*)(const IntegrateOptions& options);

[[nodiscard]] std::span<const Registered<MakeIntegrator>> integrators();

/// Errors: kUsage for an unknown integrator or ray method, naming those there are.
[[nodiscard]] Expected<std::unique_ptr<Integrator>> make_integrator(
    const IntegrateOptions& options);

}  // namespace swiftlet
