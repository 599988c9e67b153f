// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/integrate/depth_view.hpp"
#include "swiftlet/integrate/step_rounding.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {

struct VoxelCube;
struct VoxelList;
struct VoxelLook;
class CubeView;
class EvidenceSums;
struct KernelParams;
struct ModelParams;
struct RayInView;

/// How the readings of a frame become evidence about voxels (method 4 and 6): what an integrator
/// asks. It is asked once a frame, once a ray or once for a cube of voxels, never for a single one:
/// behind each function is a loop that was compiled for this model.
///
/// A frame begins with begin_frame() and ends with end_frame(). In between, an integrator asks from
/// the side of the rays, or prepares the model for its kernels and asks from the side of the
/// voxels; both give a voxel about the same evidence (measurement_model_test.cpp). Thread safety:
/// the const functions may be called from several threads at once. Real time: allocates on the
/// first frame, and when a frame sees farther than any before.
class MeasurementModel {
 public:
  virtual ~MeasurementModel() = default;

  virtual void begin_frame(const DepthView& view, const StereoSensor& sensor,
                           const RollingMap& map) = 0;
  /// After the evidence of the whole frame went into the map.
  virtual void end_frame(RollingMap& /*map*/) {}

  /// Depth [m] up to which the ray of a reading at depth z_m says something.
  [[nodiscard]] virtual double ray_end_m(double z_m) const = 0;
  /// Adds what the ray of a reading says of the voxels that it crosses.
  virtual void add_ray(const RayInView& ray, std::span<const VoxelIndex> voxels,
                       EvidenceSums& sums) const = 0;

  /// Makes ready for the kernels below, for readings up to a depth [m].
  [[nodiscard]] virtual ModelParams prepare(const CubeView& view, float farthest_m) = 0;

  // Each writes the evidence of voxels, every voxel in a lane of its own, on the widest vectors of
  // this machine. The same bits on all of them: a lane does the same operations in the same order
  // whatever the number of lanes. Evidence is that of a whole frame; `block` is the whole block,
  // `evidence` its kBlockVoxels voxels.

  /// Voxels that every ray through them passes clearly. REQUIRES: z > 2 voxels.
  virtual void fill_free(const KernelParams& params, const VoxelCube& cube,
                         FixedSteps* evidence) const = 0;
  /// Voxels that every reading passes: free as far as the pixels of their image have one.
  virtual void fill_passed(const KernelParams& params, const VoxelCube& block,
                           const VoxelList& voxels, const VoxelLook& look,
                           FixedSteps* evidence) const = 0;
  /// Any voxels: the mean of the model over the tiles at samples of their image.
  virtual void fill_sampled(const KernelParams& params, const VoxelCube& block,
                            const VoxelList& voxels, const VoxelLook& look,
                            FixedSteps* evidence) const = 0;

  /// Scratch memory [bytes].
  [[nodiscard]] virtual std::size_t memory_bytes() const { return 0; }
};

using MeasurementModelPtr = std::unique_ptr<MeasurementModel>;

}  // namespace swiftlet
