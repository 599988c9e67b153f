// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/evidence_sums.hpp"

#include <limits>

namespace swiftlet {
namespace {

constexpr BlockIndex kNowhere{std::numeric_limits<std::int32_t>::max(), 0, 0};

std::size_t place_in(const BlockWindow& window, const BlockIndex& b) {
  const auto nx = static_cast<std::size_t>(window.size.x);
  const auto ny = static_cast<std::size_t>(window.size.y);
  const auto x = static_cast<std::size_t>(b.x - window.first.x);
  const auto y = static_cast<std::size_t>(b.y - window.first.y);
  const auto z = static_cast<std::size_t>(b.z - window.first.z);
  return (z * ny + y) * nx + x;
}

}  // namespace

void EvidenceSums::begin(const BlockWindow& window) {
  for (const BlockIndex& block : touched_) slot_of_[place_in(window_, block)] = kUntouched;
  touched_.clear();
  window_ = window;
  slot_of_.resize(window.block_count(), kUntouched);
  last_block_ = kNowhere;
}

EvidenceSums::BlockSums& EvidenceSums::find_or_touch(const BlockIndex& block) {
  std::uint32_t& slot = slot_of_[place_in(window_, block)];
  if (slot == kUntouched) {
    slot = static_cast<std::uint32_t>(touched_.size());
    touched_.push_back(block);
    if (sums_.size() < touched_.size()) sums_.emplace_back();
  }
  last_block_ = block;
  last_slot_ = slot;
  return sums_[slot];
}

std::size_t EvidenceSums::apply(std::uint64_t frame_number, RollingMap& map) {
  std::size_t voxels = 0;
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    BlockSums& sums = sums_[i];
    for (std::size_t k = 0; k < kBlockVoxels; ++k)
      sums.steps[k] = (sums.steps[k] & ~kNotFree) | (sums.ends[k] > 0 ? kNotFree : 0);
    voxels += add_evidence(sums.steps, rounding_seed(touched_[i], frame_number),
                           map.writable(touched_[i]));
    sums = {};
  }
  return voxels;
}

std::size_t EvidenceSums::memory_bytes() const {
  return slot_of_.capacity() * sizeof(slot_of_[0]) + touched_.capacity() * sizeof(touched_[0]) +
         sums_.capacity() * sizeof(BlockSums);
}

}  // namespace swiftlet
