// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/session/mapping_summary.hpp"
#include "swiftlet/session/session_observer.hpp"
#include "swiftlet/store/stream/block_store.hpp"

namespace swiftlet {

/// Where a session writes, and who looks on.
struct SessionOptions {
  std::string path;                     ///< of the map file
  BlockStoreOptions store{};            ///< how the map file is written
  MapMeta meta{};                       ///< lines that describe the map (docs/formats/map_file.md)
  SessionObserver* observer = nullptr;  ///< null: nobody looks on; else it outlives the session
};

/// Maps frames into files: one a world, since poses that lose their place begin a new one. A file
/// is made when the first frame of its world has been integrated and not before, so that input
/// without any use leaves none. A map that the first one replaces stands aside until all are saved.
///
/// A disk that refuses does not end the flight, which maps on in memory: what is lost is counted,
/// and save() says so.
/// Thread safety: none, one owner.
class MappingSession {
 public:
  /// Errors: those of Mapper::create().
  [[nodiscard]] static Expected<std::unique_ptr<MappingSession>> create(
      const MapperConfig& config, const SessionOptions& options);

  /// Fuses one frame; one of a new world goes into a map and a file of its own, unless
  /// map.on_new_world is `keep`. Errors: kUsage, kInvalidConfig, kIo if the first file cannot be
  /// made.
  [[nodiscard]] Status integrate(const Frame& frame);

  /// Writes what is left, closes the files and counts what they hold.
  /// Errors: kIo if blocks were lost or a file is not whole; the rest is in the files that the
  /// summary lists. REQUIRES: has_map().
  [[nodiscard]] Status save();

  /// Whether any frame has been integrated, so that there is a file.
  [[nodiscard]] bool has_map() const { return !paths_.empty(); }
  /// Where the map is that should have been replaced, if save() has left it; else empty.
  [[nodiscard]] const std::filesystem::path& aside() const { return aside_; }

  /// What the session did so far.
  [[nodiscard]] const MappingSummary& summary() const { return summary_; }
  /// For what the caller knows of the flight.
  [[nodiscard]] MappingSummary& summary() { return summary_; }

 private:
  /// Stands in for the store until there is one: in a new map there is nothing to restore yet.
  class LateArchive final : public BlockArchive {
   public:
    explicit LateArchive(const SessionOptions& options)
        : observer_(options.observer), drops_(options.store.policy == StorePolicy::kDrop) {}
    void attach(BlockArchive& store) { store_ = &store; }
    void detach() { store_ = nullptr; }
    void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override {
      if (store_ != nullptr) store_->evict(index, block, version);
      if (store_ == nullptr && !drops_) ++lost_;
      if (observer_ != nullptr) observer_->block_left(index, block, version);
    }
    [[nodiscard]] bool restore(const BlockIndex& index, VoxelBlock& out) override {
      return store_ != nullptr && store_->restore(index, out);
    }
    void expect_around(const BlockWindow& window) override {
      if (store_ != nullptr) store_->expect_around(window);
    }

    /// Blocks that came while there was no store.
    [[nodiscard]] std::uint64_t lost() const { return lost_; }

   private:
    BlockArchive* store_ = nullptr;
    SessionObserver* observer_;
    bool drops_;
    std::uint64_t lost_ = 0;
  };

  explicit MappingSession(const SessionOptions& options) : options_(options), archive_(options) {}
  [[nodiscard]] Status begin_map(const MapperConfig& config);
  [[nodiscard]] Status create_file();
  [[nodiscard]] Status create_first_file();
  [[nodiscard]] Expected<std::unique_ptr<BlockStore>> new_store(const std::filesystem::path& path,
                                                                bool overwrite);
  void adopt(std::unique_ptr<BlockStore> store, const std::filesystem::path& path);
  [[nodiscard]] Expected<SavedFile> read_back(const std::filesystem::path& path) const;
  void start_again(std::uint32_t pose_epoch);
  void close_file();
  void mark_saved();
  void count_losses();
  void keep_failure(Error failure);
  void book(const Frame& frame, const MapUpdate& update);

  SessionOptions options_;
  std::filesystem::path aside_;  // the map that is to be replaced; empty if there is none
  MappingSummary summary_;
  // In this order: the mapper calls the archive, which calls the store, which reads the map.
  std::unique_ptr<BlockStore> store_;
  LateArchive archive_;
  std::unique_ptr<Mapper> mapper_;
  std::optional<Eigen::Vector3d> start_m_;  // of this world; nullopt until a frame is integrated
  std::uint32_t pose_epoch_ = 0;
  std::vector<std::filesystem::path> paths_;  // of the files so far
  std::uint64_t lost_before_ = 0;             // blocks, in files that are closed
  std::optional<Error> failure_;              // the first
};

}  // namespace swiftlet
