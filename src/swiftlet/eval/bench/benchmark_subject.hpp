// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "swiftlet/eval/truth/dense_grid.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet::eval {

/// A way from raw depth images and poses to a map, as `swiftlet bench` measures and `swiftlet
/// score` judges it.
class BenchmarkSubject {
 public:
  virtual ~BenchmarkSubject() = default;
  /// Fuses one frame and tells the time it took: what is done to the depth image before the map is
  /// asked counts as Stage::kPreprocess. nullopt if it refused the frame.
  virtual std::optional<StageTimes> fuse(const Frame& frame) = 0;
  /// Memory of the map alone, without scratch; 0 if there is none.
  [[nodiscard]] virtual std::size_t map_bytes() const = 0;
  /// Tells what the map claims of every voxel of claims.box().
  virtual void read_claims(Claims& claims) const = 0;
};

/// Ours: the whole mapper. `keeps_all`: what leaves the window is kept, too, and belongs to the
/// claims. Errors: those of Mapper::create().
[[nodiscard]] Expected<std::unique_ptr<BenchmarkSubject>> make_mapper_subject(
    const MapperConfig& config, bool keeps_all = false);

/// OctoMap's insertPointCloud(), the conversion to its point cloud included; null if Swiftlet was
/// built without OctoMap. `is_discretised`: one ray a voxel, OctoMap's own short cut.
[[nodiscard]] std::unique_ptr<BenchmarkSubject> make_octomap_subject(const MapperConfig& config,
                                                                     bool is_discretised);

/// No map: only the points [m, world] of a frame, all of it in Stage::kPreprocess.
[[nodiscard]] std::unique_ptr<BenchmarkSubject> make_points_subject(const MapperConfig& config);

}  // namespace swiftlet::eval
