// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/condition/neighbour_kernels.hpp"

#include <algorithm>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/condition/neighbour_kernels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::ScalableTag<std::uint16_t>;
using WordLanes = hn::Vec<Words>;

HWY_INLINE auto agrees(WordLanes a, WordLanes z, WordLanes tolerance) {
  const WordLanes apart = hn::Or(hn::SaturatedSub(a, z), hn::SaturatedSub(z, a));
  return hn::Eq(hn::SaturatedSub(apart, tolerance), hn::Zero(Words{}));
}

/// Counts the readings of a square that agree with its middle, and adds up how much deeper they
/// are, modulo 2^16.
template <int Reach>
HWY_INLINE void gather(const NeighbourRow& row, int width) {
  constexpr Words w;
  const WordLanes one = hn::Set(w, 1);
  for (int u = 0; u < width; u += static_cast<int>(hn::Lanes(w))) {
    const WordLanes z = hn::LoadU(w, row.image->row(row.v) + u);
    const WordLanes tolerance = hn::LoadU(w, row.tolerance + u);
    WordLanes count = hn::Zero(w), sum = hn::Zero(w);
    for (int dv = -Reach; dv <= Reach; ++dv) {
      const std::uint16_t* const neighbours = row.image->row(row.v + dv) + u;
      for (int du = -Reach; du <= Reach; ++du) {
        const WordLanes a = hn::LoadU(w, neighbours + du);
        const auto yes = agrees(a, z, tolerance);
        sum = hn::Add(sum, hn::IfThenElseZero(yes, hn::Sub(a, z)));
        count = hn::Add(count, hn::IfThenElseZero(yes, one));
      }
    }
    hn::StoreU(count, w, row.count + u);
    hn::StoreU(sum, w, row.sum + u);
  }
}

void gather_3(const NeighbourRow& row, int width) { gather<1>(row, width); }
void gather_5(const NeighbourRow& row, int width) { gather<2>(row, width); }

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(gather_3);
HWY_EXPORT(gather_5);

namespace {

/// At most so much, so that 25 differences add up to less than 2^15.
constexpr float kMostTolerance = 1300.0F;

}  // namespace

NoiseTolerance noise_tolerance(const ConditionedDepth& depth) {
  constexpr float kDeviations = 3.0F * 1.41421356F;
  return {1.0F, 0.01F, kDeviations * depth.noise_per_m * depth.unit_m};
}

void NeighbourSums::take(const Image<std::uint16_t>& image) {
  image_.take(image);
  const std::size_t room = static_cast<std::size_t>(image.width()) + BorderedImage::kSlack;
  tolerance_.resize(room);
  count_.resize(room);
  sum_.resize(room);
  width_ = image.width();
}

void NeighbourSums::gather(int v, int reach, const NoiseTolerance& t) {
  const std::uint16_t* const z = image_.row(v);
  for (int u = 0; u < width_; ++u) {
    const auto depth = static_cast<float>(z[u]);
    const float tolerance = t.least + t.per_depth * depth + t.per_square * depth * depth;
    // Less than the reading, so that 0 never agrees.
    const float most = std::min(kMostTolerance, depth - 1.0F);
    tolerance_[static_cast<std::size_t>(u)] =
        static_cast<std::uint16_t>(static_cast<int>(std::max(0.0F, std::min(tolerance, most))));
  }
  const NeighbourRow row{&image_, v, tolerance_.data(), count_.data(), sum_.data()};
  if (reach == 1) {
    HWY_DYNAMIC_DISPATCH(gather_3)(row, width_);
  } else {
    HWY_DYNAMIC_DISPATCH(gather_5)(row, width_);
  }
}

void BorderedImage::take(const Image<std::uint16_t>& image) {
  if (image.width() != width_ || image.height() != height_) {
    width_ = image.width();
    height_ = image.height();
    constexpr std::size_t kAround = std::size_t{2} * kBorder;
    stride_ = static_cast<std::size_t>(width_) + kAround + kSlack;
    pixels_.assign(stride_ * (static_cast<std::size_t>(height_) + kAround), 0);
  }
  for (int v = 0; v < image.height(); ++v) {
    std::ranges::copy(image.row(v),
                      &pixels_[static_cast<std::size_t>(v + kBorder) * stride_ + kBorder]);
  }
}

}  // namespace swiftlet
#endif
