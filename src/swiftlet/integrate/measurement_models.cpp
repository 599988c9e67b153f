// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/measurement_models.hpp"

#include <array>

#include "swiftlet/base/registry.hpp"

// A measurement model is one file in models/, which ends in make_<name>(), and one line here: name,
// depth step, summary.
#define SWIFTLET_MEASUREMENT_MODELS(X)                                                  \
  X(inverse_sensor_model, "",                                                           \
    "the thesis's rule: occupied within the noise of a reading, free "                  \
    "before it, unknown behind; the fastest")                                           \
  X(thin_obstacle_preserving, "", "the same, and what is thinner than a voxel is kept") \
  X(precision_weighted, "smooth",                                                       \
    "the most exact map: readings weighted by their precision, "                        \
    "and thin obstacles kept")

namespace swiftlet {

#define SWIFTLET_DECLARE(name, depth_step, summary) MeasurementModelPtr make_##name();
SWIFTLET_MEASUREMENT_MODELS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const MeasurementModelEntry> measurement_models() {
#define SWIFTLET_LINE(name, depth_step, summary) \
  MeasurementModelEntry{#name, summary, depth_step, make_##name},
  static constexpr std::array kModels{SWIFTLET_MEASUREMENT_MODELS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kModels;
}

Expected<MeasurementModelEntry> find_measurement_model(std::string_view name) {
  return find_registered(measurement_models(), name, "measurement model");
}

}  // namespace swiftlet
