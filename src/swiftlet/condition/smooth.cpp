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
    const NoiseTolerance tolerance = noise_tolerance(depth.noise_per_m, depth.unit_m);
    neighbours_.take(depth.raw);
    for (int v = 0; v < depth.raw.height(); ++v) {
      neighbours_.gather(v, 2, tolerance);
      const auto row = depth.raw.row(v);
      for (int u = 0; u < depth.raw.width(); ++u) {
        std::uint16_t& d = row[static_cast<std::size_t>(u)];
        const float deeper = static_cast<float>(neighbours_.sum(u)) /
                             static_cast<float>(std::max(neighbours_.count(u), 1));
        const long mean = std::lround(static_cast<float>(d) + deeper);
        d = static_cast<std::uint16_t>(d == 0 ? 0 : mean);
      }
    }
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
