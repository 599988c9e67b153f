// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet {

/// Who is told of a flight while it goes on. Called by the mapping thread, which must not wait.
class SessionObserver {
 public:
  virtual ~SessionObserver() = default;
  /// A new map begins; frames until the next call belong to it.
  virtual void map_begun(const Mapper& mapper) = 0;
  /// After each frame, whatever became of it.
  virtual void frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) = 0;
  /// A block leaves the window; see BlockArchive::evict().
  virtual void block_left(const BlockIndex& index, const VoxelBlock& block,
                          std::uint64_t version) = 0;
};

}  // namespace swiftlet
