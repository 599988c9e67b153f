// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/block_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace swiftlet {
namespace {

/// A voxel's image is about so many tiles wide.
constexpr float kTilesAcross = 6.0F;
/// Seen at a slant it is larger than a square of that width, up to 1.7 times.
constexpr float kSamplesPerTile = 1.3F, kFewest = 4.0F;
/// From so many voxels on, all voxels of a block look alike.
constexpr float kFarVoxels = 24.0F;

/// Whether the voxels of a cube are all surely free: more free evidence changes none of them.
bool is_surely_free(const VoxelBlock* block, int edge, int offset) {
  if (block == nullptr) return false;
  std::uint64_t any = 0;
  for (int z = 0; z < edge; ++z) {
    for (int y = 0; y < edge; ++y) {
      const int first = offset + kBlockEdge * (y + kBlockEdge * z);
      std::uint64_t row = 0;
      std::memcpy(&row, block->voxels.data() + first, static_cast<std::size_t>(edge));
      any |= row;
    }
  }
  static_assert(kFreeVoxel == 0);
  return any == 0;
}

}  // namespace

struct FrameEvidence::Work {
  const VoxelBlock* known;
  VoxelCube block;
  BlockEvidence& evidence;
  bool has_free = false;
};

FrameEvidence::FrameEvidence(const CubeView& view, const DepthView& depth,
                             const DepthMeanPyramid& means, const MeasurementModel& model,
                             const KernelParams& params)
    : view_(view),
      tiles_(depth.pyramid.tiles()),
      means_(means),
      model_(model),
      params_(params),
      frame_number_(depth.frame_number) {}

void FrameEvidence::intersect_octants(const CubeInView& cube, int edge, UpdateType type,
                                      OctantUpdates& octants) const {
  CubeBatch batch;
  for (std::size_t i = 0; i < octants.cubes.size(); ++i) {
    octants.cubes[i] = view_.child(cube, edge, static_cast<int>(i));
    batch.add(octants.cubes[i].p_camera);
  }
  batch.half_camera = octants.cubes[0].half_camera;
  octants.types.fill(type);
  if (type != UpdateType::kFree) intersect(batch, octants.types);
}

VoxelCube FrameEvidence::voxels_of(const CubeInView& cube, int edge, int offset) const {
  const float to_first = 0.5F * static_cast<float>(1 - edge) * params_.voxel_m;
  VoxelCube voxels{cube.p_world, cube.p_camera, edge, offset};
  for (int i = 0; i < 3; ++i) {
    voxels.p_world[i] += to_first;
    voxels.p_camera[i] +=
        to_first * (params_.world_axis[0][i] + params_.world_axis[1][i] + params_.world_axis[2][i]);
  }
  return voxels;
}

bool FrameEvidence::collect(const BlockIndex& index, UpdateType type, const VoxelBlock* known,
                            BlockEvidence& evidence) const {
  if (type != UpdateType::kPossiblyOccupied && is_surely_free(known, kBlockEdge, 0)) return false;
  evidence.steps.fill(0);
  evidence.passed.count = evidence.sampled.count = 0;
  const CubeInView cube = view_.cube(first_voxel(index), kBlockEdge);
  Work work{known, voxels_of(cube, kBlockEdge, 0), evidence};
  descend(cube, kBlockEdge, 0, type, work);
  look(cube, work);
  return work.has_free || std::ranges::any_of(evidence.steps, [](FixedSteps e) { return e != 0; });
}

/// Lets the listed voxels of a cube look at their readings.
void FrameEvidence::look(const CubeInView& cube, Work& work) const {
  VoxelList &passed = work.evidence.passed, &sampled = work.evidence.sampled;
  if (passed.count + sampled.count == 0) return;
  // Tiles of a fraction of a voxel's width, and as many samples as there are such tiles. What noise
  // blurs needs to be told apart less finely.
  const float z_m = std::max(cube.p_camera[2], params_.voxel_m);
  const float width_px = params_.fx * params_.voxel_m / z_m;
  const float noise_voxels = params_.sigma_per_z2 * z_m * z_m / params_.voxel_m;
  const float tiles_across = std::max(1.0F, kTilesAcross / (1.0F + noise_voxels));
  const int shift = std::clamp(static_cast<int>(std::lround(std::log2(width_px / tiles_across))),
                               DepthMeanPyramid::kFinestShift, DepthMeanPyramid::kCoarsestShift);
  const float across = width_px / static_cast<float>(1 << shift);
  const bool is_near = cube.z_near() < kNearVoxels * params_.voxel_m;
  const float count =
      is_near ? float{FaceSamples::kMost}
              : std::clamp(kSamplesPerTile * across * across, kFewest, float{FaceSamples::kMost});
  VoxelLook look{.samples = {},
                 .tiles = means_.tiles(shift),
                 .is_inside_image = !is_near && view_.is_inside_image(cube)};
  look.samples.spread(static_cast<int>(count), cube.p_world, params_.voxel_m, params_.world_axis,
                      frame_number_);
  passed.fill_last_group();
  sampled.fill_last_group();
  FixedSteps* steps = work.evidence.steps.data();
  model_.fill_passed(params_, work.block, passed, look, steps);
  model_.fill_sampled(params_, work.block, sampled, look, steps);
  passed.count = sampled.count = 0;
}

void FrameEvidence::descend(const CubeInView& cube, int edge, int offset, UpdateType type,
                            Work& work) const {
  if (type == UpdateType::kUnobserved) return;
  if (type != UpdateType::kPossiblyOccupied && is_surely_free(work.known, edge, offset)) return;
  if (type == UpdateType::kFree && edge >= 4) {
    model_.fill_free(params_, voxels_of(cube, edge, offset), work.evidence.steps.data());
    work.has_free = true;
    return;
  }
  // What passes a cube passes its parts; single voxels are not worth the question.
  if (edge == 2 || (edge == 4 && type != UpdateType::kPossiblyOccupied)) {
    VoxelList& voxels =
        type == UpdateType::kPossiblyOccupied ? work.evidence.sampled : work.evidence.passed;
    voxels.add_cube(offset, edge);
    return;
  }
  const int half = edge / 2;
  OctantUpdates octants;
  intersect_octants(cube, half, type, octants);
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1, y = (i >> 1) & 1, z = i >> 2;
    const CubeInView& part = octants.cubes[static_cast<std::size_t>(i)];
    descend(part, half, offset + half * (x + kBlockEdge * (y + kBlockEdge * z)),
            octants.types[static_cast<std::size_t>(i)], work);
    // Near the camera, each part of a block needs samples of its own.
    if (edge == kBlockEdge && cube.p_camera[2] < kFarVoxels * params_.voxel_m) look(part, work);
  }
}

}  // namespace swiftlet
