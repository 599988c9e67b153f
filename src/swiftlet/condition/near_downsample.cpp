// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <utility>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/condition/depth_step.hpp"

namespace swiftlet {
namespace {

/// A reading counts as support when it lies at most this far behind the nearest, relative to it.
constexpr double kSupportBand = 0.05;

/// Method 2: every n x n block becomes its smallest valid depth, with the pixel it was measured at,
/// so that the point in space is a real one. Blocks cut off by the right and lower edge count too.
class NearDownsample final : public DepthStep {
 public:
  explicit NearDownsample(const ConditionOptions& o) : ratio_(o.downsample) {}

  void apply(ConditionedDepth& depth) override {
    SWIFTLET_REQUIRE(depth.ratio == 1, "the image is reduced once");
    if (ratio_ <= 1) return;
    const auto blocks = [this](int pixels) { return (pixels + ratio_ - 1) / ratio_; };
    reduced_.resize(blocks(depth.raw.width()), blocks(depth.raw.height()));
    depth.origin.resize(reduced_.width(), reduced_.height());
    for (int v = 0; v < reduced_.height(); ++v) {
      for (int u = 0; u < reduced_.width(); ++u) {
        const PixelOrigin nearest = nearest_in_block(depth.raw, u, v);
        depth.origin.at(u, v) = nearest;
        reduced_.at(u, v) =
            nearest.valid == 0 ? std::uint16_t{0} : depth.raw.at(nearest.u, nearest.v);
      }
    }
    std::swap(depth.raw, reduced_);
    depth.ratio = ratio_;
  }

 private:
  [[nodiscard]] PixelOrigin nearest_in_block(const Image<std::uint16_t>& raw, int block_u,
                                             int block_v) const {
    const int u0 = block_u * ratio_, u1 = std::min(u0 + ratio_, raw.width());
    const int v0 = block_v * ratio_, v1 = std::min(v0 + ratio_, raw.height());
    PixelOrigin nearest;
    std::uint16_t smallest = 0;
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        const std::uint16_t d = raw.at(u, v);
        if (d == 0) continue;
        ++nearest.valid;
        if (smallest != 0 && d >= smallest) continue;
        smallest = d;
        nearest.u = to<std::uint16_t>(u);
        nearest.v = to<std::uint16_t>(v);
      }
    }
    const double limit = smallest * (1.0 + kSupportBand);
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        const std::uint16_t d = raw.at(u, v);
        if (d != 0 && d <= limit) ++nearest.support;
      }
    }
    return nearest;
  }

  int ratio_;
  Image<std::uint16_t> reduced_;
};

}  // namespace

std::unique_ptr<DepthStep> make_near_downsample(const ConditionOptions& options) {
  return std::make_unique<NearDownsample>(options);
}

}  // namespace swiftlet
