// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "swiftlet/integrate/image/depth_mean_kernels.hpp"
#include "swiftlet/integrate/projective/cube_view.hpp"
#include "swiftlet/integrate/projective/face_samples.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// A cube of voxels within a block, relative to the camera.
struct VoxelCube {
  Float3 p_world;   ///< centre of the first voxel [m, world axes]
  Float3 p_camera;  ///< the same in camera axes
  int edge;         ///< 4 or 8
  int offset;       ///< of the first voxel in its block
};

/// Voxels of a block that have to look at their readings, each one lane of a kernel.
struct VoxelList {
  static constexpr std::size_t kSpare = 16;  // a kernel reads whole vectors

  std::size_t count = 0;
  std::array<std::uint16_t, kBlockVoxels> offset;                      ///< in the block
  alignas(64) std::array<float, kBlockVoxels + kSpare> x{}, y{}, z{};  ///< voxels from its first

  void add_cube(int first, int edge) {
    for (int row = 0; row < edge * edge; ++row) {
      const int place = first + kBlockEdge * (row % edge + kBlockEdge * (row / edge));
      for (int i = 0; i < edge; ++i) add(place + i);
    }
  }
  /// The lanes of the last group that have no voxel do what the first one does.
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

/// How voxels look at their image: the samples on their faces, and the tiles that these fall into.
struct VoxelLook {
  FaceSamples samples;
  DepthMeanTiles tiles;
  bool is_inside_image;  ///< all of the voxels: no sample needs to ask
};

}  // namespace swiftlet
