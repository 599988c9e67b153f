// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "support/seeds.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/station/map_model.hpp"

namespace swiftlet::station {

/// What is told of a small live world.
inline MapInfo small_info() {
  MapInfo info;
  info.source = "sim:test";
  info.version = "1.2.3";
  info.is_live = true;
  info.header.voxel_m = 0.1;
  info.trigger_m = {1.0, 1.0, 0.5};
  info.min_range_m = 0.2;
  info.max_range_m = 5.0;
  info.stages = {"preprocess", "recentre", "integrate", "publish"};
  info.verdicts = {"integrated", "no_readings"};
  info.losses = {"no_pose", "pose_gap"};
  return info;
}

/// A map and a mapping thread's end of the feed, driven at random: voxels change, the vehicle moves
/// on, blocks leave the window.
class RandomFlight {
 public:
  explicit RandomFlight(test::Random& random)
      : random_(random), map_(*RollingMap::create({0.1, {4.0, 4.0, 1.6}, {0.5, 0.5, 0.5}})) {
    feed.begin_world(map_.reader(), small_info());
  }

  /// One frame.
  void step() {
    position_ += random_.vector(-0.4, 0.7);
    position_.z() = 0.0;
    Archive archive(*this);
    FrameReport report;
    report.has_shifted = map_.recentre(position_, &archive).moved;
    const VoxelIndex at = voxel_containing(position_, map_.voxel_m());
    for (int i = 0; i < 300; ++i) {
      const VoxelIndex v{at.x + random_.integer(-18, 18), at.y + random_.integer(-18, 18),
                         at.z + random_.integer(-7, 7)};
      if (!map_.window().contains(block_of(v))) continue;
      map_.writable(block_of(v)).voxels[offset_in_block(v)] =
          static_cast<QuantizedLogOdds>(random_.integer(0, 255));
    }
    map_.publish({++frames_});
    report.number = static_cast<std::uint32_t>(frames_);
    report.T_world_camera =
        Transform<World, Camera>::trusted(Eigen::Quaterniond::Identity(), position_);
    feed.report(report);
  }

  /// What a ground station should know by now.
  [[nodiscard]] MapDigest truth() const {
    MapMirror all(small_info().header);
    for (const auto& [index, block] : outside_) {
      if (!map_.window().contains(index)) all.put(index, block, 1);
    }
    map_.for_each_known_block(
        [&](const BlockIndex& index, const VoxelBlock& block) { all.put(index, block, 1); });
    return all.digest();
  }

  LiveFeed feed;

 private:
  /// Forgets what comes back, as `--store drop` does.
  class Archive final : public BlockArchive {
   public:
    explicit Archive(RandomFlight& flight) : flight_(flight) {}
    void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override {
      flight_.outside_[index] = block;
      flight_.feed.evicted(index, block, version);
    }
    bool restore(const BlockIndex& index, VoxelBlock& out) override {
      const auto found = flight_.outside_.find(index);
      if (found == flight_.outside_.end()) return false;
      out = found->second;
      flight_.outside_.erase(found);
      return true;
    }
    void expect_around(const BlockWindow&) override {}

   private:
    RandomFlight& flight_;
  };

  test::Random& random_;
  RollingMap map_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  std::uint64_t frames_ = 0;
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> outside_;
};

}  // namespace swiftlet::station
