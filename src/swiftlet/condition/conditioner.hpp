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

  /// `sigma_per_z2` as in ConditionedDepth. The result belongs to the conditioner and is good until
  /// the next call. REQUIRES: the image has the size of its intrinsics.
  [[nodiscard]] const ConditionedDepth& clean(const DepthImage& depth,
                                              const PinholeIntrinsics& lens, double sigma_per_z2);

 private:
  Conditioner() = default;
  std::vector<std::unique_ptr<DepthStep>> steps_;
  ConditionedDepth depth_;
};

}  // namespace swiftlet
