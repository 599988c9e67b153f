// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/models/thin_obstacle_preserving.hpp"

#include "swiftlet/integrate/models/inverse_sensor_evidence.hpp"

namespace swiftlet {

MeasurementModelPtr make_thin_obstacle_preserving() {
  return std::make_unique<ThinObstaclePreserving<InverseSensorEvidence>>();
}

}  // namespace swiftlet
