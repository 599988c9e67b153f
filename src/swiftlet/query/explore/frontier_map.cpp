// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/explore/frontier_map.hpp"

#include <array>

namespace swiftlet {
namespace {

constexpr std::uint64_t kFirstColumn = block_bits::kBytes;       // x = 0
constexpr std::uint64_t kLastColumn = block_bits::kBytes << 7U;  // x = 7

std::array<BlockIndex, 6> neighbours_of(const BlockIndex& b) {
  return {{{b.x - 1, b.y, b.z},
           {b.x + 1, b.y, b.z},
           {b.x, b.y - 1, b.z},
           {b.x, b.y + 1, b.z},
           {b.x, b.y, b.z - 1},
           {b.x, b.y, b.z + 1}}};
}

}  // namespace

void FrontierMap::begin(const MapSnapshot& map) {
  directory_ = BlockDirectory(map.window().size);
  directory_.move_to(map.window().first);
  entries_.assign(directory_.entry_count(), Entry{});
  waiting_.clear();
  waiting_.reserve(directory_.entry_count());
  voxel_m_ = map.voxel_m();
  voxel_count_ = 0;
}

void FrontierMap::wait(const BlockIndex& b) {
  if (!is_within(b)) return;
  Entry& entry = entries_[directory_.entry_of(b)];
  if (entry.is_waiting) return;
  entry.is_waiting = true;
  waiting_.push_back(b);
}

void FrontierMap::wait_around(const BlockIndex& b) {
  for (const BlockIndex& neighbour : neighbours_of(b)) wait(neighbour);
}

void FrontierMap::move_to(const BlockWindow& to) {
  const BlockWindow from = window();
  for_each_block_outside(from, to, [&](const BlockIndex& leaving) {
    Entry& entry = entries_[directory_.entry_of(leaving)];
    voxel_count_ -= entry.voxel_count;
    entry = Entry{};
  });
  directory_.move_to(to.first);
  // Those beside it had it for a neighbour.
  for_each_block_outside(from, to, [&](const BlockIndex& left) { wait_around(left); });
}

bool FrontierMap::look_at(const BlockIndex& b, const MapSnapshot& map) {
  Entry& entry = entries_[directory_.entry_of(b)];
  const std::uint64_t version = map.version(b);
  if (version == entry.seen) return false;
  const bool was_seen = entry.seen != kNeverSeen;
  entry.seen = version;
  BlockBits free{}, unknown{};
  const VoxelBlock* block = map.find(b);
  const bool is_prior_unknown = thresholds_.classify(kUnknownVoxel) == Occupancy::kUnknown;
  for (int z = 0; z < kBlockEdge; ++z) {
    const auto layer = static_cast<std::size_t>(z);
    if (block == nullptr) {
      unknown[layer] = is_prior_unknown ? ~std::uint64_t{0} : 0;
      continue;
    }
    const std::uint64_t occupied = voxels_at_least(*block, z, thresholds_.occupied_from);
    const std::uint64_t above_free = voxels_at_least(*block, z, thresholds_.free_below);
    free[layer] = ~(occupied | above_free);
    unknown[layer] = above_free & ~occupied;
  }
  if (was_seen && free == entry.free && unknown == entry.unknown) return false;
  entry.free = free;
  entry.unknown = unknown;
  return true;
}

const BlockBits& FrontierMap::unknown_of(const BlockIndex& b) const {
  static constexpr BlockBits kNone{};
  return is_within(b) ? entries_[directory_.entry_of(b)].unknown : kNone;
}

void FrontierMap::search(const BlockIndex& b) {
  Entry& entry = entries_[directory_.entry_of(b)];
  entry.is_waiting = false;
  const auto around = neighbours_of(b);
  const BlockBits& before_x = unknown_of(around[0]);
  const BlockBits& behind_x = unknown_of(around[1]);
  const BlockBits& before_y = unknown_of(around[2]);
  const BlockBits& behind_y = unknown_of(around[3]);
  const BlockBits& own = entry.unknown;
  int count = 0;
  for (std::size_t z = 0; z < own.size(); ++z) {
    const std::uint64_t u = own[z];
    const std::uint64_t below = z > 0 ? own[z - 1] : unknown_of(around[4]).back();
    const std::uint64_t above = z + 1 < own.size() ? own[z + 1] : unknown_of(around[5]).front();
    const std::uint64_t left = (u << 1U & ~kFirstColumn) | (before_x[z] >> 7U & kFirstColumn);
    const std::uint64_t right = (u >> 1U & ~kLastColumn) | (behind_x[z] << 7U & kLastColumn);
    const std::uint64_t front = u << 8U | before_y[z] >> 56U;
    const std::uint64_t back = u >> 8U | behind_y[z] << 56U;
    entry.frontier[z] = entry.free[z] & (left | right | front | back | below | above);
    count += std::popcount(entry.frontier[z]);
  }
  voxel_count_ = voxel_count_ - entry.voxel_count + static_cast<std::size_t>(count);
  entry.voxel_count = static_cast<std::uint16_t>(count);
}

FrontierMap::Work FrontierMap::update(const MapSnapshot& map) {
  const bool is_another = entries_.empty() || map.window().size != window().size ||
                          map.voxel_m() != voxel_m_ || map.frame_count() < frame_count_;
  if (is_another) begin(map);
  if (map.window() != window()) move_to(map.window());
  frame_count_ = map.frame_count();
  Work work;
  for_each_block(window(), [&](const BlockIndex& b) {
    if (!look_at(b, map)) return;
    ++work.blocks_changed;
    wait(b);
    wait_around(b);
  });
  work.blocks_searched = waiting_.size();
  for (const BlockIndex& b : waiting_) search(b);
  waiting_.clear();
  return work;
}

}  // namespace swiftlet
