// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "swiftlet/integrate/image/depth_mean_kernels.hpp"
#include "swiftlet/integrate/projective/cube_view.hpp"
#include "swiftlet/integrate/projective/evidence_table.hpp"
#include "swiftlet/integrate/projective/face_samples.hpp"
#include "swiftlet/integrate/step_rounding.hpp"

namespace swiftlet {

/// What the kernels know of one frame and its sensor. Lengths in metres, images in pixels.
struct KernelParams {
  std::array<Float3, 3> world_axis;  ///< of the world, in camera axes
  float fx, fy;
  float u_offset, v_offset;  ///< principal point + 0.5: floor() of a place is its pixel
  float width, height;
  float voxel_m;
  bool has_chords;  ///< ChordModel, not InverseSensorModel
  /// Cells whose cubes lie farther than a reading's depth + reach_sigma deviations + hidden_m are
  /// hidden by it, those nearer than its depth - kInFrontSigma deviations - passed_m passed, and so
  /// clearly that they get clear_log_odds with clear_m.
  float hidden_m, passed_m, clear_m, reach_sigma;
  float unit_m, sigma_per_z2;
  float per_sigma;           ///< 1 / sigma_per_z2
  const float* model;        ///< EvidenceTable; not with chords
  float steps_per_log_odds;  ///< FixedSteps
  float free_log_odds, clear_log_odds;
};

/// A cube of cells within a block, relative to the camera.
struct CellCube {
  Float3 p_world;   ///< centre of the first cell [m, world axes]
  Float3 p_camera;  ///< the same in camera axes
  int edge;         ///< 4 or 8
  int offset;       ///< of the first cell in its block
};

/// Cells of a block that have to look at their readings, each one lane of a kernel.
struct CellList {
  static constexpr std::size_t kSpare = 16;  // a kernel reads whole vectors

  std::size_t count = 0;
  std::array<std::uint16_t, kBlockVoxels> offset;                      ///< in the block
  alignas(64) std::array<float, kBlockVoxels + kSpare> x{}, y{}, z{};  ///< cells from its first

  void add_cube(int first, int edge) {
    for (int row = 0; row < edge * edge; ++row) {
      const int place = first + kBlockEdge * (row % edge + kBlockEdge * (row / edge));
      for (int i = 0; i < edge; ++i) add(place + i);
    }
  }
  /// The lanes of the last group that have no cell do what the first one does.
  void fill_last_group() {
    for (std::size_t i = count; i < count + kSpare; ++i) {
      x[i] = x[0];
      y[i] = y[0];
      z[i] = z[0];
    }
  }

 private:
  void add(int place) {
    const int row = place / kBlockEdge, layer = row / kBlockEdge;
    offset[count] = static_cast<std::uint16_t>(place);
    x[count] = static_cast<float>(place % kBlockEdge);
    y[count] = static_cast<float>(row % kBlockEdge);
    z[count] = static_cast<float>(layer);
    ++count;
  }
};

/// How cells look at their image: the samples on their faces, and the tiles that these fall into.
struct CellLook {
  FaceSamples samples;
  DepthMeanTiles tiles;
  bool is_inside_image;  ///< all of the cells: no sample needs to ask
};

// Each fills the evidence of cells, every cell in a lane of its own, on the widest vectors of this
// machine. The same bits on all of them: a lane does the same operations in the same order whatever
// the number of lanes. Evidence is that of a whole frame (method 6); `block` is the whole block.

/// Cells that every ray through them passes. REQUIRES: z > 2 cells.
void fill_free(const KernelParams& params, const CellCube& cube, FixedSteps* evidence);

/// Cells that every reading passes: free as far as the pixels of their image have one.
void fill_passed(const KernelParams& params, const CellCube& block, const CellList& cells,
                 const CellLook& look, FixedSteps* evidence);

/// Any cells: the mean of the inverse sensor model over the tiles at samples of their image.
void fill_sampled(const KernelParams& params, const CellCube& block, const CellList& cells,
                  const CellLook& look, FixedSteps* evidence);

}  // namespace swiftlet
