// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/depth_doubt.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace swiftlet {
namespace {

constexpr int kDoubtStride_px = 8;
constexpr float kReach_m = 1.0F;
constexpr float kFar_m = 10.0F;  // a structured-light camera hardly sees that far

float at_share(std::vector<std::uint16_t>& values, double share, float unit_m) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + rank);
  return static_cast<float>(values[static_cast<std::size_t>(rank)]) * unit_m;
}

}  // namespace

void DepthDoubt::note(const DepthImage& depth) {
  if (!unit_m_) return;
  seen_.clear();
  for (int v = 0; v < depth.raw.height(); v += kDoubtStride_px) {
    for (int u = 0; u < depth.raw.width(); u += kDoubtStride_px) {
      if (depth.raw.at(u, v) != 0) seen_.push_back(depth.raw.at(u, v));
    }
  }
  if (seen_.empty()) return;
  ++images_;
  reach_m_ = std::max(reach_m_, at_share(seen_, 0.95, depth.unit_m));
  if (at_share(seen_, 0.5, depth.unit_m) > kFar_m) ++far_images_;
}

std::string DepthDoubt::text() const {
  if (!unit_m_ || images_ == 0) return {};
  if (reach_m_ < kReach_m) {
    return fmt::format(
        "all that it sees is nearer than {:.2f} m: are its images in steps of {:g} m, which "
        "nobody told? else say depth_unit_m",
        reach_m_, *unit_m_);
  }
  if (2 * far_images_ > images_) {
    return fmt::format(
        "most of what it sees is farther than {:.0f} m: are its images in steps of {:g} m, which "
        "nobody told? else say depth_unit_m",
        kFar_m, *unit_m_);
  }
  return {};
}

}  // namespace swiftlet
