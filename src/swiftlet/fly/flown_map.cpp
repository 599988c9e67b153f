// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/flown_map.hpp"

#include <string>
#include <utility>

#include "swiftlet/map/memory_archive.hpp"
#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {
namespace {

/// Keeps what leaves the window, and tells who looks on.
class WatchedArchive final : public BlockArchive {
 public:
  explicit WatchedArchive(SessionObserver* observer) : observer_(observer) {}
  void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override {
    kept_.evict(index, block, version);
    if (observer_ != nullptr) observer_->block_left(index, block, version);
  }
  [[nodiscard]] bool restore(const BlockIndex& index, VoxelBlock& out) override {
    return kept_.restore(index, out);
  }
  void expect_around(const BlockWindow&) override {}
  [[nodiscard]] const BlockMap& blocks() const { return kept_.blocks(); }

 private:
  SessionObserver* observer_;
  MemoryArchive kept_;
};

class SwiftletMap final : public FlownMap {
 public:
  SwiftletMap(std::unique_ptr<WatchedArchive> archive, Mapper mapper, SessionObserver* observer)
      : archive_(std::move(archive)), mapper_(std::move(mapper)), observer_(observer) {
    if (observer_ != nullptr) observer_->map_begun(mapper_);
  }

  bool integrate(const Frame& frame) override {
    const MapUpdate update = mapper_.integrate(frame);
    if (observer_ != nullptr) observer_->frame_done(frame, update, mapper_);
    return update.verdict == FrameVerdict::kIntegrated;
  }
  RollingMap& window() override { return mapper_.map(); }
  std::uint64_t frame_count() const override { return mapper_.frame_count(); }
  std::size_t known_voxels() const override {
    VoxelCounts counts;
    const OccupancyThresholds& thresholds = mapper_.config().occupancy;
    mapper_.map().for_each_known_block(
        [&](const BlockIndex&, const VoxelBlock& block) { counts.add(block, thresholds); });
    archive_->blocks().for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
      // What came back is in the window, too.
      if (!mapper_.map().window().contains(index)) counts.add(block, thresholds);
    });
    return counts.free + counts.occupied;
  }

 private:
  std::unique_ptr<WatchedArchive> archive_;  // outlives the mapper
  Mapper mapper_;
  SessionObserver* observer_;
};

}  // namespace

Expected<FlownMapPtr> make_swiftlet_map(const MapperConfig& config, SessionObserver* observer) {
  auto archive = std::make_unique<WatchedArchive>(observer);
  auto mapper = Mapper::create(config, archive.get());
  if (!mapper) return forward_error(std::move(mapper));
  return std::make_unique<SwiftletMap>(std::move(archive), std::move(*mapper), observer);
}

Expected<FlownMapPtr> make_flown_map(std::string_view name, const MapperConfig& config) {
  if (name == "swiftlet") return make_swiftlet_map(config);
  if (name == "octomap") return make_octomap_map(config);
  return fail(ErrorCode::kUsage, "map", "there is no map '" + std::string(name) + "' to fly on",
              "swiftlet, octomap");
}

}  // namespace swiftlet
