// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/preprocess/neighbour_kernels.hpp"

namespace swiftlet {
namespace {

/// Drops what LonePixels drops, and averages the rest. The noise of a pixel is not its neighbour's,
/// so the mean of those of 5 x 5 that lie on the same surface is sharper than any of them. 25 of
/// independent noise would leave a fifth of the deviation; matching windows overlap and edges have
/// fewer, so the map is told to expect kNoiseLeft of it.
class Smooth final : public DepthStep {
 public:
  explicit Smooth(const PreprocessOptions&) {}

  void apply(PreprocessedDepth& depth) override {
    constexpr float kNoiseLeft = 0.3F;
    neighbours_.average(depth);
    depth.noise_left *= kNoiseLeft;
  }

 private:
  Neighbours neighbours_;
};

}  // namespace

std::unique_ptr<DepthStep> make_smooth(const PreprocessOptions& options) {
  return std::make_unique<Smooth>(options);
}

}  // namespace swiftlet
