// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/preprocess/depth_step.hpp"

namespace swiftlet {

/// Raw depth to trustworthy depth: the configured steps in their order.
class Preprocessor {
 public:
  /// Errors: kUsage for a step that does not exist, naming those that do.
  [[nodiscard]] static Expected<Preprocessor> create(const PreprocessOptions& options);

  /// `sigma_per_z2` as in PreprocessedDepth. The result belongs to the preprocessor and is good
  /// until the next call. REQUIRES: the image has the size of its intrinsics.
  [[nodiscard]] const PreprocessedDepth& clean(const DepthImage& depth,
                                               const PinholeIntrinsics& intrinsics,
                                               double sigma_per_z2);

 private:
  Preprocessor() = default;
  std::vector<std::unique_ptr<DepthStep>> steps_;
  PreprocessedDepth depth_;
};

}  // namespace swiftlet
