// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/preprocess/neighbour_kernels.hpp"

namespace swiftlet {
namespace {

/// At a depth edge a stereo camera mixes fore- and background, and where it matches wrongly it
/// reports anything: such readings float in the air, and no neighbour has their depth. A rod of two
/// pixels has five to bear each other out.
class LonePixels final : public DepthStep {
 public:
  explicit LonePixels(const PreprocessOptions&) {}

  void apply(PreprocessedDepth& depth) override { neighbours_.keep_supported(depth); }

 private:
  Neighbours neighbours_;
};

}  // namespace

std::unique_ptr<DepthStep> make_lone_pixels(const PreprocessOptions& options) {
  return std::make_unique<LonePixels>(options);
}

}  // namespace swiftlet
