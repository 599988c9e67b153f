// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/distance/distance_field.hpp"

namespace swiftlet {

class DistanceFieldStore;

/// A distance field as it stood after one whole update; never changes while it is held.
/// Thread safety: any thread. While every slot of the thread is held, it publishes nothing newer.
class HeldDistanceField {
 public:
  /// The field.
  [[nodiscard]] const DistanceField& operator*() const { return *field_; }
  /// The field.
  [[nodiscard]] const DistanceField* operator->() const { return field_; }

  /// Holds the same field once more.
  HeldDistanceField(const HeldDistanceField& other);
  /// Takes it over; `other` can only be assigned to or destroyed.
  HeldDistanceField(HeldDistanceField&& other) noexcept;
  /// Lets go of what it holds, and holds the other's.
  HeldDistanceField& operator=(HeldDistanceField other) noexcept;
  ~HeldDistanceField();

 private:
  friend class DistanceFieldStore;
  HeldDistanceField(std::shared_ptr<DistanceFieldStore> store, int slot,
                    const DistanceField* field);

  std::shared_ptr<DistanceFieldStore> store_;  // null only after a move
  int slot_;
  const DistanceField* field_;
};

/// Keeps a distance field up to date on a thread of its own, as the map grows, and publishes it as
/// a map is published: readers get whole fields and never wait, and neither does the thread.
///
/// There are three fields: the newest, one that is being brought up to date, and one that a slow
/// reader may hold. Each follows the map for itself, so none is ever copied; memory is three times
/// that of a DistanceField. Under load frames of the map are skipped, never halves of one.
/// Real time: allocates nothing after create(). Looks for a newer map every millisecond or two, as
/// a mapper does not wait to tell anybody.
class DistanceFieldThread {
 public:
  static constexpr int kFields = 3;  ///< one newest, one in work, one held by a slow reader

  /// `reader`: of a map of these voxels and of a window of this size (RollingMap::voxel_m(),
  /// window()). Errors: as DistanceField::create().
  [[nodiscard]] static Expected<DistanceFieldThread> start(MapReader reader, double voxel_m,
                                                           const BlockIndex& window_size,
                                                           const DistanceFieldOptions& options);

  /// The newest field; its frame_count() says which frame of the map it belongs to. Nullopt before
  /// the first. Any thread; never blocks.
  [[nodiscard]] std::optional<HeldDistanceField> latest() const;

  /// What the thread did so far.
  struct Tally {
    std::uint64_t published = 0;  ///< fields that readers could see
    std::uint64_t skipped = 0;    ///< newer maps that found every field held by readers
  };
  /// From any thread.
  [[nodiscard]] Tally tally() const;

  /// Takes the other's place.
  DistanceFieldThread(DistanceFieldThread&& other) noexcept;
  /// Takes the other's place.
  DistanceFieldThread& operator=(DistanceFieldThread&& other) noexcept;
  /// Ends the thread; held fields live on.
  ~DistanceFieldThread();

 private:
  class Worker;
  explicit DistanceFieldThread(std::unique_ptr<Worker> worker);
  std::unique_ptr<Worker> worker_;
};

}  // namespace swiftlet
