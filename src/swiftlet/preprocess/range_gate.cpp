// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>
#include <limits>

#include "swiftlet/preprocess/depth_step.hpp"

namespace swiftlet {
namespace {

/// In device units: 2 m are 2000 mm, though 0.001 as a float is a little more than a millimetre.
constexpr double kSlack = 1e-3;

/// Readings outside [min, max] become 0. What lies beyond the far limit is no evidence at all, not
/// free space up to the limit: a mismatch in the far field must not clear the near one.
class RangeGate final : public DepthStep {
 public:
  explicit RangeGate(const PreprocessOptions& o) : min_m_(o.min_range_m), max_m_(o.max_range_m) {}

  void apply(PreprocessedDepth& depth) override {
    const double unit_m = depth.unit_m;
    const std::uint16_t nearest = device_units(std::ceil(min_m_ / unit_m - kSlack));
    const std::uint16_t farthest = device_units(std::floor(max_m_ / unit_m + kSlack));
    for (std::uint16_t& d : depth.raw.pixels()) {
      const bool is_inside = d >= nearest && d <= farthest;
      d = is_inside ? d : std::uint16_t{0};
    }
  }

 private:
  static std::uint16_t device_units(double units) {
    return static_cast<std::uint16_t>(
        std::clamp(units, 1.0, double{std::numeric_limits<std::uint16_t>::max()}));
  }

  double min_m_;
  double max_m_;
};

}  // namespace

std::unique_ptr<DepthStep> make_range_gate(const PreprocessOptions& options) {
  return std::make_unique<RangeGate>(options);
}

}  // namespace swiftlet
