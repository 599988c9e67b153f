// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/step_rounding.hpp"

#include <algorithm>

namespace swiftlet {
namespace {

constexpr std::size_t kRow = kBlockEdge;

/// A draw from [0, 2^20), the middle of one of 2^16 equal parts.
FixedSteps dither(std::uint64_t word, std::size_t lane) {
  return static_cast<FixedSteps>(((word >> (16 * lane)) & 0xffffU) << 4U) + 8;
}

}  // namespace

std::size_t add_evidence(std::span<const FixedSteps, kBlockVoxels> evidence, std::uint64_t seed,
                         VoxelBlock& block) {
  std::size_t voxels = 0;
  for (std::size_t row = 0; row < kBlockVoxels; row += kRow) {
    const FixedSteps* e = &evidence[row];
    FixedSteps any = 0;
    for (std::size_t i = 0; i < kRow; ++i) any |= e[i];
    if (any == 0) continue;
    const std::uint64_t words[2] = {mix_bits(seed + row), mix_bits(seed + row + 1)};
    for (std::size_t i = 0; i < kRow; ++i) {
      // Without evidence the draw alone never makes a step.
      const FixedSteps steps = (e[i] + dither(words[i / 4], i % 4)) >> kStepFractionBits;
      const QuantizedLogOdds before = block.voxels[row + i], after = add_steps(before, steps);
      const bool is_kept = after < before && (e[i] & kNotFree) != 0;
      block.voxels[row + i] = is_kept ? std::max(after, std::min(before, kUnknownVoxel)) : after;
      voxels += e[i] != 0 ? 1 : 0;
    }
  }
  return voxels;
}

}  // namespace swiftlet
