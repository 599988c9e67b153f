// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/rolling_map.hpp"

#include <cmath>
#include <string>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

constexpr double kMaxBlocks = 1 << 24;

Status validate(const RollingMap::Options& o) {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (!positive(o.voxel_m) || o.voxel_m > RollingMap::kMaxCoordinate_m || o.voxel_m < 1e-3) {
    return fail(ErrorCode::kInvalidConfig, "map.voxel_m",
                "the voxel size must lie between 1 mm and 1000 km");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!positive(o.trigger_m[axis])) {
      return fail(ErrorCode::kInvalidConfig, "map.trigger_m",
                  "the trigger box must have positive half extents");
    }
    if (!positive(o.size_m[axis]) || o.size_m[axis] < o.voxel_m) {
      return fail(ErrorCode::kInvalidConfig, "map.size_m",
                  "the window must hold at least one voxel along each axis");
    }
  }
  return Done{};
}

/// Whole blocks that cover size_m, and one to spare.
Eigen::Vector3d blocks_for(const RollingMap::Options& o) {
  const double block_m = o.voxel_m * kBlockEdge;
  // 1e-9: 1.6 m are one block of 0.2 m voxels, whatever the last bit of the division says.
  return ((o.size_m / block_m).array() - 1e-9).ceil() + 1.0;
}

}  // namespace

Expected<RollingMap> RollingMap::create(const Options& options, const LogOddsScale& scale) {
  if (auto valid = validate(options); !valid) return forward_error(std::move(valid));
  const Eigen::Vector3d n = blocks_for(options);
  if (n.prod() > kMaxBlocks) {
    const double gib = n.prod() * sizeof(VoxelBlock) / (1U << 30U);
    return fail(ErrorCode::kInvalidConfig, "map.size_m",
                "the window would take " + std::to_string(std::llround(gib)) + " GiB, more than 8",
                "make it smaller or map.voxel_m larger");
  }
  const BlockIndex size{static_cast<std::int32_t>(n.x()), static_cast<std::int32_t>(n.y()),
                        static_cast<std::int32_t>(n.z())};
  const std::size_t window_blocks = BlockWindow{{}, size}.block_count();
  auto pool = BlockPool::create(window_blocks * (1 + SnapshotStore::kSlots));
  if (!pool) return forward_error(std::move(pool));
  return RollingMap(options, scale, std::move(*pool), size);
}

RollingMap::RollingMap(const Options& options, const LogOddsScale& scale, BlockPool pool,
                       const BlockIndex& window_size)
    : options_(options),
      scale_(scale),
      store_(std::make_shared<SnapshotStore>(std::move(pool), window_size)),
      directory_(window_size) {}

BlockIndex RollingMap::first_block_around(const Eigen::Vector3d& p_world) const {
  const BlockIndex& size = window().size;
  const Eigen::Array3d p_blocks = p_world.array() / (options_.voxel_m * kBlockEdge);
  const Eigen::Array3d first = (p_blocks - 0.5 * Eigen::Array3d(size.x, size.y, size.z)).round();
  return {static_cast<std::int32_t>(first.x()), static_cast<std::int32_t>(first.y()),
          static_cast<std::int32_t>(first.z())};
}

RollingMap::Shift RollingMap::recentre(const Eigen::Vector3d& p_world, BlockArchive* archive) {
  SWIFTLET_REQUIRE(p_world.allFinite() && p_world.cwiseAbs().maxCoeff() < kMaxCoordinate_m,
                   "the vehicle must be at a finite place within 1000 km");
  Shift shift;
  const bool is_inside =
      anchor_ && ((p_world - *anchor_).cwiseAbs().array() <= options_.trigger_m.array()).all();
  if (is_inside) return shift;

  const bool is_first = !anchor_;
  anchor_ = p_world;
  const BlockWindow old_window = window();
  const BlockWindow new_window{first_block_around(p_world), old_window.size};
  if (new_window == old_window && !is_first) return shift;
  shift.moved = true;

  for_each_block_outside(old_window, new_window, [&](const BlockIndex& leaving) {
    const std::size_t entry = directory_.entry_of(leaving);
    const BlockId id = directory_.at(entry);
    if (id == kNoBlock) return;
    if (archive != nullptr) {
      archive->evict(leaving, store_->pool().block(id), store_->pool().born(id));
      ++shift.blocks_evicted;
    }
    store_->drop(id);
    directory_.set(entry, kNoBlock);
  });
  directory_.move_to(new_window.first);
  if (archive == nullptr) return shift;

  VoxelBlock restored;
  const auto enter = [&](const BlockIndex& entering) {
    if (!archive->restore(entering, restored)) return;
    writable(entering) = restored;
    ++shift.blocks_restored;
  };
  if (is_first) {
    for_each_block(new_window, enter);
  } else {
    for_each_block_outside(new_window, old_window, enter);
  }
  archive->expect_around(new_window);
  return shift;
}

void RollingMap::clear() {
  for_each_block(window(), [&](const BlockIndex& index) {
    const std::size_t entry = directory_.entry_of(index);
    const BlockId id = directory_.at(entry);
    if (id == kNoBlock) return;
    store_->drop(id);
    directory_.set(entry, kNoBlock);
  });
  anchor_.reset();
}

const VoxelBlock* RollingMap::find(const BlockIndex& index) const {
  const BlockId id = directory_.find(index);
  return id == kNoBlock ? nullptr : &store_->pool().block(id);
}

VoxelBlock& RollingMap::writable(const BlockIndex& index) {
  const std::size_t entry = directory_.entry_of(index);
  const BlockId old = directory_.at(entry);
  if (old != kNoBlock && !store_->is_shared(old)) return store_->pool().block(old);

  const BlockId fresh = store_->take();
  VoxelBlock& block = store_->pool().block(fresh);
  if (old == kNoBlock) {
    block.clear();
  } else {
    block = store_->pool().block(old);
    store_->drop(old);
  }
  directory_.set(entry, fresh);
  return block;
}

bool RollingMap::publish(const FrameMark& mark) {
  if (store_->has_readers()) return store_->publish(directory_, options_.voxel_m, scale_, mark);
  store_->withdraw();
  return true;
}

std::optional<MapSnapshot> RollingMap::snapshot(const FrameMark& mark) {
  if (!store_->publish(directory_, options_.voxel_m, scale_, mark)) return std::nullopt;
  return reader().latest();
}

std::size_t RollingMap::memory_bytes() const {
  return store_->memory_bytes() + directory_.entry_count() * sizeof(BlockId);
}

}  // namespace swiftlet
