// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// Evidence of one frame for one voxel, in steps of its byte * 2^20.
using FixedSteps = std::int32_t;
inline constexpr int kStepFractionBits = 20;
inline constexpr double kOneStep = 1 << kStepFractionBits;
/// Evidence that saturates any voxel.
inline constexpr FixedSteps kMostSteps = 255 << kStepFractionBits;
/// The last bit of evidence says that the voxel is not free: what speaks against matter in it takes
/// it to unknown at most, never on to free (PrecisionWeightedModel).
inline constexpr FixedSteps kNotFree = 1;

/// Seeds the rounding of one block in one frame.
[[nodiscard]] constexpr std::uint64_t rounding_seed(const BlockIndex& block,
                                                    std::uint64_t frame_number) {
  return mix_bits(BlockHash{}(block) ^ mix_bits(frame_number));
}

/// Adds the evidence of a frame to the voxels of a block, once and saturating. The fraction of a
/// step becomes a whole one with that probability, drawn from a hash of voxel and frame number:
/// repeatable, unbiased. Sixteen bits of hash a voxel, four voxels a word, so that a block costs
/// 128 words. Returns the number of voxels with evidence.
std::size_t add_evidence(std::span<const FixedSteps, kBlockVoxels> evidence, std::uint64_t seed,
                         VoxelBlock& block);

}  // namespace swiftlet
