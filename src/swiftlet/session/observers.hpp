// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <vector>

#include "swiftlet/session/session_observer.hpp"

namespace swiftlet {

/// Tells several of a flight, in the order in which they were added.
class Observers final : public SessionObserver {
 public:
  /// Null is nobody; else it outlives this.
  void add(SessionObserver* observer) {
    if (observer != nullptr) all_.push_back(observer);
  }

  void map_begun(const Mapper& mapper) override {
    for (SessionObserver* one : all_) one->map_begun(mapper);
  }
  void frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) override {
    for (SessionObserver* one : all_) one->frame_done(frame, update, mapper);
  }
  void block_left(const BlockIndex& index, const VoxelBlock& block,
                  std::uint64_t version) override {
    for (SessionObserver* one : all_) one->block_left(index, block, version);
  }

 private:
  std::vector<SessionObserver*> all_;
};

}  // namespace swiftlet
