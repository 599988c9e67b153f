// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/condition/depth_step.hpp"
#include "swiftlet/condition/neighbour_kernels.hpp"

namespace swiftlet {
namespace {

/// At a depth edge a stereo camera mixes fore- and background, and where it matches wrongly it
/// reports anything: such readings float in the air, and no neighbour has their depth. A rod of two
/// pixels has five to bear each other out.
class LonePixels final : public DepthStep {
 public:
  explicit LonePixels(const ConditionOptions&) {}

  void apply(ConditionedDepth& depth) override {
    constexpr int kSupport = 2;
    const NoiseTolerance tolerance = noise_tolerance(depth.noise_per_m, depth.unit_m);
    neighbours_.take(depth.raw);
    for (int v = 0; v < depth.raw.height(); ++v) {
      neighbours_.gather(v, 1, tolerance);
      const auto row = depth.raw.row(v);
      for (int u = 0; u < depth.raw.width(); ++u) {
        std::uint16_t& d = row[static_cast<std::size_t>(u)];
        d = neighbours_.count(u) > kSupport ? d : std::uint16_t{0};
      }
    }
  }

 private:
  NeighbourSums neighbours_;
};

}  // namespace

std::unique_ptr<DepthStep> make_lone_pixels(const ConditionOptions& options) {
  return std::make_unique<LonePixels>(options);
}

}  // namespace swiftlet
