// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <concepts>

#include "swiftlet/integrate/measurement_model.hpp"
#include "swiftlet/integrate/upkeep/thin_obstacle_filter.hpp"

namespace swiftlet {

/// A measurement model with the thin-obstacle filter around it: what is thinner than a voxel is not
/// erased by the rays that pass beside it.
template <std::derived_from<MeasurementModel> Model>
class ThinObstaclePreserving final : public Model {
 public:
  void begin_frame(const DepthView& view, const StereoSensor& sensor,
                   const RollingMap& map) override {
    Model::begin_frame(view, sensor, map);
    filter_.collect(view, map);
  }
  void end_frame(RollingMap& map) override {
    Model::end_frame(map);
    filter_.protect(map);
  }
  [[nodiscard]] std::size_t memory_bytes() const override {
    return Model::memory_bytes() + filter_.memory_bytes();
  }

 private:
  ThinObstacleFilter filter_;
};

}  // namespace swiftlet
