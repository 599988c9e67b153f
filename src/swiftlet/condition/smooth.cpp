// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>

#include "swiftlet/condition/depth_step.hpp"
#include "swiftlet/condition/neighbour_kernels.hpp"

namespace swiftlet {
namespace {

/// The noise of a pixel is not its neighbour's, so the mean of those of 5 x 5 that lie on the same
/// surface is sharper than any of them. 25 of independent noise would leave a fifth of the
/// deviation; matching windows overlap and edges have fewer, so the map is told to expect
/// kNoiseLeft of it.
class Smooth final : public DepthStep {
 public:
  explicit Smooth(const ConditionOptions&) {}

  void apply(ConditionedDepth& depth) override {
    constexpr float kNoiseLeft = 0.3F;
    neighbours_.replace_each(depth, 2, [](std::uint16_t d, int count, int sum) {
      const float deeper = static_cast<float>(sum) / static_cast<float>(std::max(count, 1));
      const long mean = std::lround(static_cast<float>(d) + deeper);
      return static_cast<std::uint16_t>(d == 0 ? 0 : mean);
    });
    depth.noise_left *= kNoiseLeft;
  }

 private:
  NeighbourSums neighbours_;
};

}  // namespace

std::unique_ptr<DepthStep> make_smooth(const ConditionOptions& options) {
  return std::make_unique<Smooth>(options);
}

}  // namespace swiftlet
