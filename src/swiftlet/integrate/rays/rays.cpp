// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "swiftlet/integrate/evidence_sums.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/rays/ray_method.hpp"

namespace swiftlet {
namespace {

/// The thesis's way (method 5 and 6): every reading is a ray from the camera through the cell it
/// was measured in and on to 3 sigma behind it; each cell on the way gets DW * L.
class RayIntegrator final : public Integrator {
 public:
  RayIntegrator(TraceRay trace, double logodds_per_step)
      : trace_(trace), fixed_per_logodds_(kOneStep / logodds_per_step) {}

  IntegrationTally integrate(const DepthView& view, const StereoSensor& sensor,
                             RollingMap& map) override {
    const VoxelBox box = voxel_box(map.window());
    cells_.resize(max_cells(box));
    sums_.begin(map.window());
    const Rays rays(view, map.voxel_m());

    IntegrationTally tally;
    const ConditionedDepth& depth = view.depth;
    for (int v = 0; v < depth.raw.height(); ++v) {
      for (int u = 0; u < depth.raw.width(); ++u) {
        const std::uint16_t raw = depth.raw.at(u, v);
        if (raw == 0) continue;
        const PixelOrigin pixel = depth.origin_of(u, v);
        add_reading(rays, rays.direction(pixel), double{depth.unit_m} * raw, sensor, box);
        ++tally.readings;
      }
    }
    tally.cells = sums_.apply(view.frame_number, map);
    tally.blocks = sums_.touched_blocks();
    return tally;
  }

  [[nodiscard]] std::size_t memory_bytes() const override {
    return sums_.memory_bytes() + cells_.capacity() * sizeof(VoxelIndex);
  }

 private:
  /// Depths [m] at which a ray enters and leaves a cell, and how many cells of depth that is.
  struct Chord {
    double z_in_m, z_out_m, length_cells;
  };
  /// The geometry of one view, in units of cells.
  struct Rays {
    Rays(const DepthView& view, double voxel)
        : intrinsics(view.intrinsics),
          R_world_camera(view.T_world_camera.rotation().toRotationMatrix()),
          origin(view.T_world_camera.translation() / voxel),
          optical_axis(R_world_camera.col(2)),
          voxel_m(voxel) {}

    /// Direction [cells, world] per metre of depth of the ray through a pixel.
    [[nodiscard]] Eigen::Vector3d direction(const PixelOrigin& pixel) const {
      return R_world_camera * intrinsics.back_project(pixel.u, pixel.v, 1.0) / voxel_m;
    }
    /// Depth [m, camera] of a cell's centre.
    [[nodiscard]] double depth_of(const VoxelIndex& c) const {
      return optical_axis.dot(Eigen::Vector3d(c.x + 0.5, c.y + 0.5, c.z + 0.5) - origin) * voxel_m;
    }

    /// Where a ray crosses a cell; nowhere if it only touches it, as drawn lines do.
    [[nodiscard]] Chord chord(const Eigen::Vector3d& direction, const VoxelIndex& c) const {
      Chord chord{0.0, std::numeric_limits<double>::infinity(), 0.0};
      const Eigen::Vector3d least = Eigen::Vector3d(c.x, c.y, c.z) - origin;
      for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0.0) continue;
        const double a_m = least[i] / direction[i], b_m = (least[i] + 1.0) / direction[i];
        chord.z_in_m = std::max(chord.z_in_m, std::min(a_m, b_m));
        chord.z_out_m = std::min(chord.z_out_m, std::max(a_m, b_m));
      }
      chord.z_out_m = std::max(chord.z_in_m, chord.z_out_m);
      chord.length_cells = (chord.z_out_m - chord.z_in_m) / voxel_m;
      return chord;
    }

    const PinholeIntrinsics& intrinsics;
    Eigen::Matrix3d R_world_camera;
    Eigen::Vector3d origin;
    Eigen::Vector3d optical_axis;
    double voxel_m;
  };

  struct Reading {
    double z_m, sigma_m;
  };

  void add_reading(const Rays& rays, const Eigen::Vector3d& direction, double z_m,
                   const StereoSensor& sensor, const VoxelBox& box) {
    const Reading reading{z_m, sensor.noise().sigma_m(z_m)};
    const bool has_chords = sensor.shape() == CellShape::kChord;
    const double z_end_m = has_chords ? z_m + double{ChordModel::kFadeSigma} * reading.sigma_m +
                                            double{ChordModel::kHidingCells} * rays.voxel_m
                                      : z_m + InverseSensorModel::kBandSigma * reading.sigma_m;
    const std::size_t n = trace_({rays.origin, rays.origin + z_end_m * direction}, box, cells_);
    for (std::size_t i = 0; i < n; ++i) {
      const VoxelIndex& cell = cells_[i];
      const double z_cell_m = rays.depth_of(cell);
      if (z_cell_m <= 0.0) continue;  // the camera's own cell, its centre behind the lens
      if (has_chords) {
        add_chord(cell, z_cell_m, rays.chord(direction, cell), reading, sensor);
      } else {
        add_slice(cell, z_cell_m, reading, sensor);
      }
    }
  }

  void add_slice(const VoxelIndex& cell, double z_cell_m, const Reading& reading,
                 const StereoSensor& sensor) {
    const double logodds = sensor.log_odds(z_cell_m, reading.z_m, reading.sigma_m);
    if (logodds == 0.0) return;
    const double fixed = sensor.weight(z_cell_m) * logodds * fixed_per_logodds_;
    sums_.add(cell, static_cast<FixedSteps>(std::lrint(fixed)));
  }

  /// With sharp fusion: DW * L * the length of the chord.
  void add_chord(const VoxelIndex& cell, double z_cell_m, const Chord& chord,
                 const Reading& reading, const StereoSensor& sensor) {
    constexpr double kEndUnit = 1 << 20;
    const auto said =
        sensor.chord_model().of(chord.z_in_m, chord.z_out_m, reading.z_m, reading.sigma_m);
    const double weight = sensor.weight(z_cell_m);
    const double fixed = weight * chord.length_cells * said.log_odds * fixed_per_logodds_;
    sums_.add(cell, static_cast<FixedSteps>(std::lrint(fixed)));
    sums_.add_ends(cell, static_cast<std::int32_t>(std::lrint(weight * said.ends * kEndUnit)));
  }

  TraceRay trace_;
  double fixed_per_logodds_;
  EvidenceSums sums_;
  std::vector<VoxelIndex> cells_;  // of one ray
};

}  // namespace

Expected<std::unique_ptr<Integrator>> make_rays(const IntegrateOptions& options) {
  auto method = find_ray_method(options.ray_method);
  if (!method) return forward_error(std::move(method));
  return std::make_unique<RayIntegrator>(method->trace, options.logodds_per_step);
}

}  // namespace swiftlet
