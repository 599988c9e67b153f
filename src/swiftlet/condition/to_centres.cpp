// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>
#include <limits>

#include "swiftlet/condition/depth_step.hpp"

namespace swiftlet {
namespace {

/// The sensor model gives a cell the evidence of every reading within half a cell of its centre
/// (StereoSensor::log_odds()), so a wall on the boundary of two cells fills both, the empty one in
/// front, too. Half a cell farther back the same model fills the cells whose centres lie up to a
/// cell behind the reading: those that are more than half full.
class ToCentres final : public DepthStep {
 public:
  explicit ToCentres(const ConditionOptions&) {}

  void apply(ConditionedDepth& depth) override {
    constexpr int kMost = std::numeric_limits<std::uint16_t>::max();
    const auto shift = static_cast<int>(std::lround(depth.half_cell_m / depth.unit_m));
    for (std::uint16_t& d : depth.raw.pixels()) {
      const int moved = d == 0 ? 0 : std::min(d + shift, kMost);
      d = static_cast<std::uint16_t>(moved);
    }
    depth.shift_m += static_cast<float>(shift) * depth.unit_m;
  }
};

}  // namespace

std::unique_ptr<DepthStep> make_to_centres(const ConditionOptions& options) {
  return std::make_unique<ToCentres>(options);
}

}  // namespace swiftlet
