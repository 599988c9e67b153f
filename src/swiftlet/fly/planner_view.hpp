// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <utility>

#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/explore/frontier_map.hpp"

namespace swiftlet {

/// Everything that a planner looks at, of one frame: the map, how far what is not free is away, and
/// where the known ends.
class PlannerView {
 public:
  /// For windows like this one. Errors: those of DistanceField::create().
  [[nodiscard]] static Expected<PlannerView> create(const RollingMap& window,
                                                    const OccupancyThresholds& thresholds,
                                                    double reach_m) {
    DistanceFieldOptions options;
    options.max_distance_m = reach_m;
    options.occupied = false;
    options.thresholds = thresholds;
    auto field = DistanceField::create(window.voxel_m(), window.window().size, options);
    if (!field) return forward_error(std::move(field));
    return PlannerView(std::move(*field), thresholds);
  }

  /// Takes in the window as it is now. Allocates only the first time.
  void look_at(RollingMap& window, std::uint64_t frame_count) {
    map_.reset();  // its slot may be needed
    map_ = window.snapshot({.frame_count = frame_count});
    if (!map_) return;
    field_.update(*map_);
    frontier_.update(*map_);
  }

  [[nodiscard]] bool has_map() const { return map_.has_value(); }
  /// REQUIRES: has_map().
  [[nodiscard]] const MapSnapshot& map() const { return *map_; }
  [[nodiscard]] const DistanceField& field() const { return field_; }
  [[nodiscard]] const FrontierMap& frontier() const { return frontier_; }

 private:
  PlannerView(DistanceField field, const OccupancyThresholds& thresholds)
      : field_(std::move(field)), frontier_(thresholds) {}

  std::optional<MapSnapshot> map_;
  DistanceField field_;
  FrontierMap frontier_;
};

}  // namespace swiftlet
