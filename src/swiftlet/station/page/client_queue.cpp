// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/page/client_queue.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace swiftlet::station {
namespace {

constexpr std::size_t kOrderedAtOnce = 1024;  // a tick's worth; the order is stale after that
constexpr std::int64_t kMaxOffset = 32767;    // int16 on the wire
constexpr std::size_t kFewBlocks = 4096;

std::int64_t squared_distance(const BlockIndex& a, const BlockIndex& b) {
  const std::int64_t dx = std::int64_t{a.x} - b.x;
  const std::int64_t dy = std::int64_t{a.y} - b.y;
  const std::int64_t dz = std::int64_t{a.z} - b.z;
  return dx * dx + dy * dy + dz * dz;
}

bool fits_beside(const BlockIndex& base, const BlockIndex& b) {
  const auto near = [](std::int64_t from, std::int64_t to) {
    return std::abs(to - from) <= kMaxOffset;
  };
  return near(base.x, b.x) && near(base.y, b.y) && near(base.z, b.z);
}

}  // namespace

void ClientQueue::start_again(const MapMirror& mirror) {
  dirty_.clear();
  order_.clear();
  ledger_.clear();
  clears_next_ = true;
  mirror.for_each_known_block(
      [&](const BlockIndex& index, const VoxelBlock&) { dirty_.insert(index); });
}

void ClientQueue::mark(const std::vector<BlockIndex>& changed, const MapMirror& mirror) {
  if (changed.empty()) return;
  dirty_.insert(changed.begin(), changed.end());
  order_.clear();  // new ones may be nearer
  // Blocks that have gone pile up behind a client that takes nothing.
  if (dirty_.size() > 2 * std::max<std::size_t>(mirror.digest().blocks, kFewBlocks)) {
    start_again(mirror);
  }
}

void ClientQueue::order_nearest(const BlockIndex& centre) {
  std::vector<std::pair<std::int64_t, BlockIndex>> keyed;
  keyed.reserve(dirty_.size());
  for (const BlockIndex& b : dirty_) keyed.emplace_back(squared_distance(centre, b), b);
  const std::size_t count = std::min(keyed.size(), kOrderedAtOnce);
  std::ranges::partial_sort(keyed, keyed.begin() + static_cast<std::ptrdiff_t>(count));
  order_.clear();
  for (std::size_t i = count; i-- > 0;) order_.push_back(keyed[i].second);
}

ClientQueue::Batch ClientQueue::next(const BlockIndex& centre, std::size_t max_blocks) {
  Batch batch;
  batch.clears_first = std::exchange(clears_next_, false);
  while (batch.blocks.size() < max_blocks && !dirty_.empty()) {
    if (order_.empty()) order_nearest(centre);
    const BlockIndex block = order_.back();
    if (!batch.blocks.empty() && !fits_beside(batch.blocks.front(), block)) break;
    order_.pop_back();
    if (dirty_.erase(block) > 0) batch.blocks.push_back(block);
  }
  return batch;
}

void ClientQueue::sent(std::uint32_t sequence, Batch&& batch) {
  ledger_.push_back({sequence, std::move(batch)});
  if (ledger_.size() > kPacketsRemembered) ledger_.pop_front();
}

void ClientQueue::resend(std::uint32_t first, std::uint32_t last, const MapMirror& mirror) {
  if (ledger_.empty()) return;  // nothing with blocks was lost
  const bool is_remembered =
      first <= last && (ledger_.size() < kPacketsRemembered || first >= ledger_.front().sequence);
  if (!is_remembered) {
    start_again(mirror);
    return;
  }
  for (const Sent& packet : ledger_) {
    if (packet.sequence < first || packet.sequence > last) continue;
    if (packet.batch.clears_first) {
      start_again(mirror);  // the client still holds what it was to drop
      return;
    }
    dirty_.insert(packet.batch.blocks.begin(), packet.batch.blocks.end());
  }
  order_.clear();
}

}  // namespace swiftlet::station
