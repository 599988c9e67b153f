// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/state/live_feed.hpp"

#include <utility>

namespace swiftlet::station {

LiveFeed::LiveFeed() {
  filling_.reserve(kEvicted);
  taken_.reserve(kEvicted);
}

void LiveFeed::begin_world(MapReader reader, const MapInfo& info) {
  const std::lock_guard lock(mutex_);
  filling_.clear();
  course_.reset();
  begun_ = World{world_.load() + 1, info, std::move(reader)};
  world_.store(begun_->number);
}

void LiveFeed::report(FrameReport report) {
  report.world = world_.load(std::memory_order_relaxed);
  (void)reports_.push(report);  // the ring counts what it has no room for
}

void LiveFeed::lost(const std::array<std::uint32_t, kMaxLosses>& counts) {
  for (std::size_t i = 0; i < kMaxLosses; ++i) {
    losses_[i].store(counts[i], std::memory_order_relaxed);
  }
}

std::array<std::uint32_t, kMaxLosses> LiveFeed::losses() const {
  std::array<std::uint32_t, kMaxLosses> counts{};
  for (std::size_t i = 0; i < kMaxLosses; ++i) {
    counts[i] = losses_[i].load(std::memory_order_relaxed);
  }
  return counts;
}

void LiveFeed::evicted(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) {
  const std::lock_guard lock(mutex_);
  if (filling_.size() < kEvicted) {
    filling_.push_back({index, version, block});
  } else {
    evicted_missed_.fetch_add(1);
  }
}

void LiveFeed::depth(const DepthImage& image) {
  if (!wants_depth_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(depth_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;  // the next one will do
  wants_depth_.store(false);
  depth_ = image;
  has_new_depth_ = true;
}

bool LiveFeed::take_depth(DepthImage& out) {
  const std::lock_guard lock(depth_mutex_);
  if (!has_new_depth_) return false;
  std::swap(out, depth_);
  has_new_depth_ = false;
  return true;
}

void LiveFeed::course(const Course& course) {
  std::optional<Course> newest = course;  // and then the older one, which goes after the lock
  const std::lock_guard lock(mutex_);
  course_.swap(newest);
}

std::optional<Course> LiveFeed::take_course() {
  const std::lock_guard lock(mutex_);
  return std::exchange(course_, std::nullopt);
}

std::optional<LiveFeed::World> LiveFeed::world_after(std::uint32_t number) {
  if (world_.load() == number) return std::nullopt;
  const std::lock_guard lock(mutex_);
  taken_.clear();
  return std::exchange(begun_, std::nullopt);
}

const std::vector<LiveFeed::EvictedBlock>& LiveFeed::take_evicted() {
  taken_.clear();
  const std::lock_guard lock(mutex_);
  if (!begun_) std::swap(taken_, filling_);  // else they are of a world not yet asked for
  return taken_;
}

}  // namespace swiftlet::station
