// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/condition/depth_step.hpp"
#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet {

/// Raw depth to trustworthy depth: the configured steps in their order.
class Conditioner {
 public:
  /// Errors: kUsage for a step that does not exist, naming those that do.
  [[nodiscard]] static Expected<Conditioner> create(const ConditionOptions& options);

  /// What the steps may know besides the image; see ConditionedDepth.
  struct Setting {
    double noise_per_m = 0.004;
    double half_cell_m = 0.0;
  };

  /// The result belongs to the conditioner and is good until the next call.
  /// REQUIRES: the image has the size of its intrinsics.
  [[nodiscard]] const ConditionedDepth& clean(const DepthImage& depth,
                                              const PinholeIntrinsics& lens,
                                              const Setting& setting);

 private:
  Conditioner() = default;
  std::vector<std::unique_ptr<DepthStep>> steps_;
  ConditionedDepth depth_;
};

}  // namespace swiftlet
