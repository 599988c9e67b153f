// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/integrate/measurement_model.hpp"

namespace swiftlet {

/// One line of the table of measurement models.
struct MeasurementModelEntry {
  std::string_view name;
  std::string_view summary;
  std::string_view
      depth_step;  ///< the conditioning step that it wants behind the range gate, if any
  MeasurementModelPtr (*make)();
};

[[nodiscard]] std::span<const MeasurementModelEntry> measurement_models();

/// Errors: kUsage for an unknown name, naming those there are.
[[nodiscard]] Expected<MeasurementModelEntry> find_measurement_model(std::string_view name);

}  // namespace swiftlet
