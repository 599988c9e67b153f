// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/integrate/depth_view.hpp"
#include "swiftlet/integrate/measurement_model.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

/// Everything that the integrators can be told.
struct IntegrateOptions {
  std::string integrator = "projective";
  std::string model = "precision_weighted";  ///< one of measurement_models()
  std::string ray_method = "voxel_traversal";
  double logodds_per_step = 0.04;  ///< one step of a voxel's byte, so +-127 steps are +-5.08
  int threads = 1;                 ///< of the projective integrator; same map bits for any number
  double decay_s = 0.0;            ///< see OccupancyDecay; 0: never
  double max_frame_ms = 0.0;       ///< far blocks are left out once this is over; 0: never
};

/// What one frame did to the map.
struct IntegrationTally {
  std::size_t readings = 0;     ///< valid pixels that were fused
  std::size_t voxels = 0;       ///< voxels that received evidence; surely free ones may be left out
  std::size_t blocks = 0;       ///< blocks that hold them
  std::size_t blocks_left = 0;  ///< in view, but left out of this frame by max_frame_ms
};

/// Turns the evidence of a whole frame into belief.
///
/// Law: a frame gives the same map bits whatever the order of its pixels and the number of threads.
/// Law: a block gets all evidence of a frame or none. None, beyond max_frame_ms: the nearest come
/// first, those left out are counted and wait for the next frame that sees them. (What keeps thin
/// obstacles works on the blocks that are left out, too.)
class Integrator {
 public:
  virtual ~Integrator() = default;

  IntegrationTally integrate(const DepthView& view, const StereoSensor& sensor,
                             MeasurementModel& model, RollingMap& map) {
    model.begin_frame(view, sensor, map);
    const IntegrationTally tally = fuse(view, sensor, model, map);
    model.end_frame(map);
    return tally;
  }
  /// Scratch memory [bytes].
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;

 private:
  virtual IntegrationTally fuse(const DepthView& view, const StereoSensor& sensor,
                                MeasurementModel& model, RollingMap& map) = 0;
};

using MakeIntegrator = Expected<std::unique_ptr<Integrator>> (*)(const IntegrateOptions& options);

[[nodiscard]] std::span<const Registered<MakeIntegrator>> integrators();

/// Errors: kUsage for an unknown integrator or ray method, naming those there are.
[[nodiscard]] Expected<std::unique_ptr<Integrator>> make_integrator(
    const IntegrateOptions& options);

}  // namespace swiftlet
