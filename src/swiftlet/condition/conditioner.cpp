// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/condition/conditioner.hpp"

namespace swiftlet {

Expected<Conditioner> Conditioner::create(const ConditionOptions& options) {
  Conditioner conditioner;
  for (const std::string& name : options.steps) {
    auto step = find_registered(depth_steps(), name, "depth step");
    if (!step) return forward_error(std::move(step));
    conditioner.steps_.push_back(step->make(options));
  }
  return conditioner;
}

const ConditionedDepth& Conditioner::clean(const DepthImage& depth, const PinholeIntrinsics& lens,
                                           double sigma_per_z2) {
  depth_.raw = depth.raw;  // same size: copies without allocating
  depth_.unit_m = depth.unit_m;
  depth_.lens = lens;
  depth_.ratio = 1;
  depth_.sigma_per_z2 = static_cast<float>(sigma_per_z2);
  depth_.noise_left = 1.0F;
  for (const auto& step : steps_) step->apply(depth_);
  return depth_;
}

}  // namespace swiftlet
