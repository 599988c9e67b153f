// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/map_snapshot.hpp"

namespace swiftlet {

const VoxelBlock* MapSnapshot::find(const BlockIndex& index) const {
  const BlockId id = slot().directory.find(index);
  return id == kNoBlock ? nullptr : &std::as_const(*store_).pool().block(id);
}

std::uint64_t MapSnapshot::version(const BlockIndex& index) const {
  const BlockId id = slot().directory.find(index);
  return id == kNoBlock ? 0 : std::as_const(*store_).pool().born(id);
}

MapSnapshot::MapSnapshot(const MapSnapshot& other) : store_(other.store_), slot_(other.slot_) {
  if (store_) store_->hold(slot_);
}

MapSnapshot::MapSnapshot(MapSnapshot&& other) noexcept
    : store_(std::move(other.store_)), slot_(other.slot_) {
  other.store_ = nullptr;
}

MapSnapshot& MapSnapshot::operator=(MapSnapshot other) noexcept {
  std::swap(store_, other.store_);
  std::swap(slot_, other.slot_);
  return *this;
}

MapSnapshot::~MapSnapshot() {
  if (store_) store_->release(slot_);
}

MapReader::MapReader(std::shared_ptr<SnapshotStore> store) : store_(std::move(store)) {
  store_->add_reader();
}

MapReader& MapReader::operator=(MapReader&& other) noexcept {
  std::swap(store_, other.store_);
  return *this;
}

MapReader::~MapReader() {
  if (store_) store_->remove_reader();
}

std::optional<MapSnapshot> MapReader::latest() const {
  const std::optional<int> slot = store_->acquire_latest();
  if (!slot) return std::nullopt;
  return MapSnapshot(store_, *slot);
}

}  // namespace swiftlet
