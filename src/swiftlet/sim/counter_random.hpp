// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet::sim {

/// Random numbers by counter: the value depends on the key alone, never on the order of the calls,
/// so that an image has the same bytes whatever the number of threads that render it.
class CounterRandom {
 public:
  /// One stream per (seed, stream number), as in (scene seed, frame).
  constexpr CounterRandom(std::uint64_t seed, std::uint64_t stream)
      : key_(mix_bits(mix_bits(seed) ^ stream)) {}

  [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t counter) const {
    return mix_bits(key_ ^ counter);
  }
  /// Uniform in (0, 1): never exactly 0 or 1.
  [[nodiscard]] constexpr float uniform(std::uint64_t counter) const {
    return unit(static_cast<std::uint32_t>(bits(counter) >> 40));
  }
  /// Mean 0, variance 1 (Box and Muller 1958).
  [[nodiscard]] float gaussian(std::uint64_t counter) const {
    const std::uint64_t word = bits(counter);
    const float radius = std::sqrt(-2.0F * std::log(unit(static_cast<std::uint32_t>(word >> 40))));
    const float turn = unit(static_cast<std::uint32_t>(word & 0xffffffU));
    return radius * std::cos(2.0F * std::numbers::pi_v<float> * turn);
  }

 private:
  static constexpr float unit(std::uint32_t bits24) {
    // 23 bits and the half keep the result representable and below 1.
    return (static_cast<float>(bits24 >> 1) + 0.5F) * 0x1p-23F;
  }
  std::uint64_t key_;
};

}  // namespace swiftlet::sim
