// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {

Expected<Preprocessor> Preprocessor::create(const PreprocessOptions& options) {
  Preprocessor preprocessor;
  for (const std::string& name : options.steps) {
    auto step = find_registered(depth_steps(), name, "depth step");
    if (!step) return forward_error(std::move(step));
    preprocessor.steps_.push_back(step->make(options));
  }
  return preprocessor;
}

const PreprocessedDepth& Preprocessor::clean(const DepthImage& depth,
                                             const PinholeIntrinsics& intrinsics,
                                             double sigma_per_z2) {
  depth_.raw = depth.raw;  // same size: copies without allocating
  depth_.unit_m = depth.unit_m;
  depth_.intrinsics = intrinsics;
  depth_.ratio = 1;
  depth_.sigma_per_z2 = static_cast<float>(sigma_per_z2);
  depth_.noise_left = 1.0F;
  for (const auto& step : steps_) step->apply(depth_);
  return depth_;
}

}  // namespace swiftlet
