// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <limits>
#include <vector>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/preprocess/depth_step.hpp"

namespace swiftlet {
namespace {

/// Along one axis of the image: what a pixel adds to the factors of the square of its depth and of
/// its depth.
struct Bend {
  float square, linear;
};

/// Method 9, eq. A.3, in device units. One pass, no branch: the compiler puts it into vectors, and
/// without fused multiply-add the bits are the same on every machine.
class Distortion final : public DepthStep {
 public:
  explicit Distortion(const PreprocessOptions& options) : distortion_(options.distortion) {}

  void apply(PreprocessedDepth& depth) override {
    if (distortion_.is_none()) return;
    SWIFTLET_REQUIRE(depth.ratio == 1, "depth is straightened before it is reduced");
    SWIFTLET_REQUIRE(depth.intrinsics.has_value(),
                     "depth is straightened with the camera's intrinsics");
    prepare(depth);
    const float offset = static_cast<float>(distortion_.offset_m) / depth.unit_m;
    for (int v = 0; v < depth.raw.height(); ++v) {
      const Bend of_row = rows_[static_cast<std::size_t>(v)];
      const auto row = depth.raw.row(v);
      for (std::size_t u = 0; u < row.size(); ++u) {
        const auto d = static_cast<float>(row[u]);
        const float square = columns_[u].square + of_row.square;
        const float linear = columns_[u].linear + of_row.linear;
        row[u] = straightened(d, d - (d * (d * square + linear) + offset));
      }
    }
  }

 private:
  /// A reading stays one only if an image can hold it; what was none stays none.
  static std::uint16_t straightened(float before, float after) {
    constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
    const bool is_reading = before > 0.0F && after >= 0.5F && after <= kMost;
    return static_cast<std::uint16_t>(static_cast<std::int32_t>(is_reading ? after + 0.5F : 0.0F));
  }

  /// Allocates only when the size of images changes.
  void prepare(const PreprocessedDepth& depth) {
    const PinholeIntrinsics& k = *depth.intrinsics;
    SWIFTLET_REQUIRE(k.width() == depth.raw.width() && k.height() == depth.raw.height(),
                     "the intrinsics are those of the image");
    const double unit_m = depth.unit_m;
    columns_.resize(static_cast<std::size_t>(k.width()));
    rows_.resize(static_cast<std::size_t>(k.height()));
    const auto fill = [&](std::vector<Bend>& bends, double centre_px, double focal_px,
                          double square_per_m, double linear) {
      for (std::size_t i = 0; i < bends.size(); ++i) {
        const double slope = (static_cast<double>(i) - centre_px) / focal_px;
        bends[i] = {static_cast<float>(square_per_m * slope * slope * unit_m),
                    static_cast<float>(linear * slope)};
      }
    };
    fill(columns_, k.cx(), k.fx(), distortion_.x2_per_m, distortion_.x1);
    fill(rows_, k.cy(), k.fy(), distortion_.y2_per_m, distortion_.y1);
  }

  DepthDistortion distortion_;
  std::vector<Bend> columns_, rows_;
};

}  // namespace

std::unique_ptr<DepthStep> make_distortion(const PreprocessOptions& options) {
  return std::make_unique<Distortion>(options);
}

}  // namespace swiftlet
