// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/preprocess/depth_distortion.hpp"
#include "swiftlet/preprocess/preprocessed_depth.hpp"

namespace swiftlet {

/// Everything that the depth steps can be told.
struct PreprocessOptions {
  std::vector<std::string> steps{"distortion", "range_gate", "near_downsample"};  ///< in order
  double min_range_m = 0.2;  ///< nearer readings are dropped: below the D435's shortest distance
  double max_range_m = 10.0;
  int downsample = 1;  ///< n of the near-preserving reduction; 1 keeps every pixel
  DepthDistortion distortion{};
};

/// One step from raw depth towards trustworthy depth. A step may drop or move readings, never
/// invent one. Keeps its buffers between frames: no allocation once it has seen an image of the
/// same size.
class DepthStep {
 public:
  virtual ~DepthStep() = default;
  virtual void apply(PreprocessedDepth& depth) = 0;
};

using MakeDepthStep = std::unique_ptr<DepthStep> (*)(const PreprocessOptions& options);

/// All depth steps there are.
[[nodiscard]] std::span<const Registered<MakeDepthStep>> depth_steps();

}  // namespace swiftlet
