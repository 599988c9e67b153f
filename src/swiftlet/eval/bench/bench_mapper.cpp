// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <utility>
#include <vector>

#include "swiftlet/eval/bench/bench_contender.hpp"
#include "swiftlet/eval/bench/bench_points.hpp"
#include "swiftlet/eval/truth/memory_archive.hpp"

namespace swiftlet::eval {
namespace {

class MapperContender final : public Contender {
 public:
  MapperContender(Mapper mapper, std::unique_ptr<MemoryArchive> archive)
      : archive_(std::move(archive)), mapper_(std::move(mapper)) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    const MapUpdate update = mapper_.integrate(frame);
    if (update.verdict != FrameVerdict::kIntegrated) return std::nullopt;
    return update.times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return mapper_.map().memory_bytes(); }

  void read_claims(Claims& claims) const override {
    const OccupancyThresholds& thresholds = mapper_.config().occupancy;
    const BlockIndex first = block_of(claims.box().first), last = block_of(claims.box().last);
    const BlockWindow blocks{first,
                             {last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1}};
    for_each_block(blocks, [&](const BlockIndex& index) {
      const VoxelBlock* block = find(index);
      for (int i = 0; i < kBlockVoxels; ++i) {
        const VoxelIndex v = voxel_at(index, i);
        if (!claims.contains(v)) continue;
        claims.at(v) = block == nullptr
                           ? Occupancy::kUnknown
                           : thresholds.classify(block->cells[static_cast<std::size_t>(i)]);
      }
    });
  }

 private:
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const {
    if (mapper_.map().window().contains(index)) return mapper_.map().find(index);
    return archive_ == nullptr ? nullptr : archive_->find(index);
  }

  std::unique_ptr<MemoryArchive> archive_;  // before the mapper, which calls it
  Mapper mapper_;
};

class PointsContender final : public Contender {
 public:
  explicit PointsContender(ConditionOptions range) : range_(std::move(range)) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    StageTimes times;
    StageTimer timer(times);
    points_.clear();
    for_each_point(frame, range_, [&](const Eigen::Vector3f& p) { points_.push_back(p); });
    timer.finish(Stage::kCondition);
    return times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return 0; }
  void read_claims(Claims& claims) const override {
    std::ranges::fill(claims.cells(), Occupancy::kUnknown);
  }

 private:
  ConditionOptions range_;
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace

Expected<std::unique_ptr<Contender>> make_mapper_contender(const MapperConfig& config,
                                                           bool keeps_all) {
  auto archive = keeps_all ? std::make_unique<MemoryArchive>() : nullptr;
  auto mapper = Mapper::create(config, archive.get());
  if (!mapper) return forward_error(std::move(mapper));
  return std::make_unique<MapperContender>(std::move(*mapper), std::move(archive));
}

std::unique_ptr<Contender> make_points_contender(const MapperConfig& config) {
  return std::make_unique<PointsContender>(config.depth);
}

}  // namespace swiftlet::eval
