// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <utility>
#include <vector>

#include "swiftlet/app/bench_contender.hpp"
#include "swiftlet/app/bench_points.hpp"

namespace swiftlet::app {
namespace {

class MapperContender final : public Contender {
 public:
  explicit MapperContender(Mapper mapper) : mapper_(std::move(mapper)) {}

  std::optional<StageTimes> fuse(const Frame& frame) override {
    const MapUpdate update = mapper_.integrate(frame);
    if (update.verdict != FrameVerdict::kIntegrated) return std::nullopt;
    return update.times;
  }
  [[nodiscard]] std::size_t map_bytes() const override { return mapper_.map().memory_bytes(); }

 private:
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

 private:
  ConditionOptions range_;
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace

Expected<std::unique_ptr<Contender>> make_mapper_contender(const MapperConfig& config) {
  auto mapper = Mapper::create(config);
  if (!mapper) return forward_error(std::move(mapper));
  return std::make_unique<MapperContender>(std::move(*mapper));
}

std::unique_ptr<Contender> make_points_contender(const MapperConfig& config) {
  return std::make_unique<PointsContender>(config.depth);
}

}  // namespace swiftlet::app
