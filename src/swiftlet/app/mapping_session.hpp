// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <string>

#include "swiftlet/app/session_observer.hpp"
#include "swiftlet/app/summary.hpp"
#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/store/tile_store.hpp"

namespace swiftlet::app {

struct SessionOptions {
  std::string path;  ///< of the map file
  TileStoreOptions store;
  MapMeta meta;
  SessionObserver* observer = nullptr;  ///< null: nobody looks on; else it outlives the session
};

/// Where a map stands while the one that replaces it is made.
[[nodiscard]] inline std::string path_aside(const std::string& path) { return path + ".bak"; }

/// Maps frames into a file. The file is made when the first frame has been integrated and not
/// before, so that input without any use leaves none. A map that it replaces stands aside until the
/// new one is saved.
/// Thread safety: none, one owner.
class MappingSession {
 public:
  /// Errors: those of Mapper::create().
  [[nodiscard]] static Expected<std::unique_ptr<MappingSession>> create(
      const MapperConfig& config, const SessionOptions& options);

  /// Fuses one frame; one of a new pose epoch begins the map and its file anew. Errors: kUsage,
  /// kInvalidConfig, kIo if the map file cannot be made; kIo if the disk has refused for so long
  /// that blocks of the map were lost.
  [[nodiscard]] Status integrate(const Frame& frame);

  /// Writes what is left and closes the file; counts what it holds.
  /// Errors: kIo; what the last good batch held is in the file. REQUIRES: has_map().
  [[nodiscard]] Status save();

  /// Whether any frame has been integrated, so that there is a file.
  [[nodiscard]] bool has_map() const { return store_ != nullptr; }

  [[nodiscard]] const MappingSummary& summary() const { return summary_; }
  [[nodiscard]] MappingSummary& summary() { return summary_; }

 private:
  /// Stands in for the store until there is one: in a new map there is nothing to restore yet.
  class LateArchive final : public BlockArchive {
   public:
    explicit LateArchive(SessionObserver* observer) : observer_(observer) {}
    void attach(BlockArchive& store) { store_ = &store; }
    void detach() { store_ = nullptr; }
    void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override {
      if (store_ != nullptr) store_->evict(index, block, version);
      if (observer_ != nullptr) observer_->block_left(index, block, version);
    }
    [[nodiscard]] bool restore(const BlockIndex& index, VoxelBlock& out) override {
      return store_ != nullptr && store_->restore(index, out);
    }
    void expect_around(const BlockWindow& window) override {
      if (store_ != nullptr) store_->expect_around(window);
    }

   private:
    BlockArchive* store_ = nullptr;
    SessionObserver* observer_;
  };

  explicit MappingSession(const SessionOptions& options)
      : options_(options), archive_(options.observer) {}
  [[nodiscard]] Status begin_map(const MapperConfig& config);
  [[nodiscard]] Status create_file(const Eigen::Vector3d& start_m);
  [[nodiscard]] Status set_old_map_aside();
  [[nodiscard]] Expected<SavedFile> read_back() const;
  [[nodiscard]] Status start_again();
  void book(const Frame& frame, const MapUpdate& update);

  SessionOptions options_;
  bool is_old_map_aside_ = false;
  MappingSummary summary_;
  // In this order: the mapper calls the archive, which calls the store, which reads the map.
  std::unique_ptr<TileStore> store_;
  LateArchive archive_;
  std::unique_ptr<Mapper> mapper_;
  std::uint32_t pose_epoch_ = 0;
};

}  // namespace swiftlet::app
