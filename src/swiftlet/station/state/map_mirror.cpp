// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/state/map_mirror.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet::station {
namespace {

void add(MapDigest& sum, const MapDigest& share) {
  sum.blocks += share.blocks;
  sum.occupied += share.occupied;
  sum.free += share.free;
  sum.hash_a += share.hash_a;
  sum.hash_b += share.hash_b;
}

void subtract(MapDigest& sum, const MapDigest& share) {
  sum.blocks -= share.blocks;
  sum.occupied -= share.occupied;
  sum.free -= share.free;
  sum.hash_a -= share.hash_a;
  sum.hash_b -= share.hash_b;
}

bool holds_only_unknown(const VoxelBlock& block) {
  return std::ranges::all_of(block.voxels,
                             [](QuantizedLogOdds voxel) { return voxel == kUnknownVoxel; });
}

}  // namespace

MapDigest MapMirror::share_of(const BlockIndex& index, const VoxelBlock& block) const {
  VoxelCounts voxels;
  voxels.add(block, scale().thresholds);
  return {1, static_cast<std::uint32_t>(voxels.occupied), static_cast<std::uint32_t>(voxels.free),
          block_hash(index, block, 0), block_hash(index, block, 1)};
}

void MapMirror::put(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) {
  const auto found = entries_.find(index);
  if (found != entries_.end() && found->second.version > version) return;
  if (holds_only_unknown(block)) {
    remove(index);
    return;
  }
  const bool is_new = found == entries_.end();
  Entry& entry = is_new ? entries_[index] : found->second;
  entry.version = version;
  VoxelBlock& kept = map_.writable(index);
  if (!is_new && kept == block) return;
  subtract(digest_, entry.share);
  kept = block;
  entry.share = share_of(index, block);
  add(digest_, entry.share);
  if (!std::exchange(entry.is_changed, true)) changes_.push_back(index);
}

void MapMirror::remove(const BlockIndex& index) {
  const auto found = entries_.find(index);
  if (found == entries_.end()) return;
  subtract(digest_, found->second.share);
  if (!found->second.is_changed) changes_.push_back(index);
  entries_.erase(found);
  map_.erase(index);
}

void MapMirror::update(const MapSnapshot& snapshot) {
  window_ = snapshot.window();
  frame_count_ = snapshot.frame_count();
  for_each_block(window_, [&](const BlockIndex& index) {
    const std::uint64_t version = snapshot.version(index);
    if (version == 0) {
      remove(index);
      return;
    }
    const auto known = entries_.find(index);
    if (known != entries_.end() && known->second.version == version) return;
    put(index, *snapshot.find(index), version);
  });
  if (entries_.size() > max_blocks_) forget_far_blocks();
}

void MapMirror::clear() {
  for (const auto& [index, entry] : entries_) {
    if (!entry.is_changed) changes_.push_back(index);
  }
  entries_.clear();
  map_.clear();
  digest_ = {};
  window_ = {};
  frame_count_ = 0;
}

BlockMap MapMirror::copy() const {
  BlockMap copy = map_;
  MapHeader header = map_.header();
  header.frame_count = frame_count_;
  copy.set_header(header);
  return copy;
}

std::vector<BlockIndex> MapMirror::take_changes() {
  for (const BlockIndex& index : changes_) {
    if (const auto found = entries_.find(index); found != entries_.end())
      found->second.is_changed = false;
  }
  // A block that went and came back between two polls is listed twice.
  std::ranges::sort(changes_);
  changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
  return std::exchange(changes_, {});
}

/// A tenth more than must be, so that this does not happen at every poll.
void MapMirror::forget_far_blocks() {
  const auto distance = [&](const BlockIndex& b) {
    const BlockIndex end = window_.end();
    const auto beyond = [](std::int64_t v, std::int64_t first, std::int64_t behind) {
      return std::max({first - v, v - behind + 1, std::int64_t{0}});
    };
    return std::max({beyond(b.x, window_.first.x, end.x), beyond(b.y, window_.first.y, end.y),
                     beyond(b.z, window_.first.z, end.z)});
  };
  std::vector<std::pair<std::int64_t, BlockIndex>> far;
  for (const auto& [index, entry] : entries_) {
    if (const auto d = distance(index); d > 0) far.emplace_back(-d, index);
  }
  const std::size_t surplus = entries_.size() - max_blocks_ + max_blocks_ / 10;
  const std::size_t count = std::min(surplus, far.size());
  std::ranges::nth_element(far, far.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count; ++i) remove(far[i].second);
}

}  // namespace swiftlet::station
