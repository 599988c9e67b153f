// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <utility>
#include <vector>

#include "swiftlet/eval/bench/bench_points.hpp"
#include "swiftlet/eval/bench/benchmark_subject.hpp"
#include "swiftlet/map/memory_archive.hpp"
#include "swiftlet/query/box_query.hpp"

namespace swiftlet::eval {
namespace {

/// The window, and around it what has left it.
class WholeFlight : public VoxelLookup<WholeFlight> {
 public:
  WholeFlight(const RollingMap& window, const MemoryArchive* left) : window_(window), left_(left) {}

  [[nodiscard]] double voxel_m() const { return window_.voxel_m(); }
  [[nodiscard]] const LogOddsScale& scale() const { return window_.scale(); }
  [[nodiscard]] BlockWindow extent() const {
    BlockWindow all = window_.extent();
    if (left_ != nullptr) all = joined(all, left_->blocks().extent());
    return all;
  }
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const {
    if (left_ == nullptr || window_.window().contains(index)) return window_.find(index);
    return left_->blocks().find(index);
  }
  template <class Visit>
  void for_each_known_block(Visit&& visit) const {
    window_.for_each_known_block(visit);
    if (left_ == nullptr) return;
    left_->blocks().for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
      if (!window_.window().contains(index)) visit(index, block);
    });
  }

 private:
  const RollingMap& window_;
  const MemoryArchive* left_;
};

class MapperSubject final : public BenchmarkSubject {
 public:
  MapperSubject(Mapper mapper, std::unique_ptr<MemoryArchive> archive)
      : archive_(std::move(archive)), mapper_(std::move(mapper)) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    const MapUpdate update = mapper_.integrate(frame);
    if (update.verdict != FrameVerdict::kIntegrated) return std::nullopt;
    return update.times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return mapper_.map().memory_bytes(); }

  void read_claims(Claims& claims) const override {
    copy_box(WholeFlight(mapper_.map(), archive_.get()), claims.box(), claims.voxels());
  }

 private:
  std::unique_ptr<MemoryArchive> archive_;  // before the mapper, which calls it
  Mapper mapper_;
};

class PointsSubject final : public BenchmarkSubject {
 public:
  explicit PointsSubject(PreprocessOptions range) : range_(std::move(range)) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    StageTimes times;
    StageTimer timer(times);
    points_.clear();
    for_each_point(frame, range_, [&](const Eigen::Vector3f& p) { points_.push_back(p); });
    timer.finish(Stage::kPreprocess);
    return times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return 0; }
  void read_claims(Claims& claims) const override {
    std::ranges::fill(claims.voxels(), Occupancy::kUnknown);
  }

 private:
  PreprocessOptions range_;
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace

Expected<std::unique_ptr<BenchmarkSubject>> make_mapper_subject(const MapperConfig& config,
                                                                bool keeps_all) {
  auto archive = keeps_all ? std::make_unique<MemoryArchive>() : nullptr;
  auto mapper = Mapper::create(config, archive.get());
  if (!mapper) return forward_error(std::move(mapper));
  return std::make_unique<MapperSubject>(std::move(*mapper), std::move(archive));
}

std::unique_ptr<BenchmarkSubject> make_points_subject(const MapperConfig& config) {
  return std::make_unique<PointsSubject>(config.depth);
}

}  // namespace swiftlet::eval
