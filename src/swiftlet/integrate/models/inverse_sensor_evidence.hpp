// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>

#include "swiftlet/integrate/measurement_model.hpp"
#include "swiftlet/integrate/models/evidence_table.hpp"

namespace swiftlet {

/// Evidence by InverseSensorModel, the thesis's rule: a voxel counts as the slice of half a voxel
/// of depth in front of and behind its centre (StereoSensor::log_odds()), and a frame gives it DW *
/// L of each reading whose ray crosses it.
class InverseSensorEvidence : public MeasurementModel {
 public:
  void begin_frame(const DepthView& view, const StereoSensor& sensor,
                   const RollingMap& map) override;
  [[nodiscard]] double ray_end_m(double z_m) const override;
  void add_ray(const RayInView& ray, std::span<const VoxelIndex> voxels,
               EvidenceSums& sums) const override;
  [[nodiscard]] ModelParams prepare(const CubeView& view, float farthest_m) override;
  void fill_free(const KernelParams& params, const VoxelCube& cube,
                 FixedSteps* evidence) const override;
  void fill_passed(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                   const VoxelLook& look, FixedSteps* evidence) const override;
  void fill_sampled(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                    const VoxelLook& look, FixedSteps* evidence) const override;
  [[nodiscard]] std::size_t memory_bytes() const override { return table_.memory_bytes(); }

 private:
  std::optional<StereoSensor> sensor_;  // of this frame
  EvidenceTable table_;
};

}  // namespace swiftlet
