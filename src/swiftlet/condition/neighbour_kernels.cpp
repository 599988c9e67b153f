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
using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using FloatLanes = hn::Vec<Floats>;
using FewWords = hn::Rebind<std::uint16_t, Floats>;
using FewSigned = hn::Rebind<std::int16_t, Floats>;

/// At most so much, so that 25 differences add up to less than 2^15.
constexpr float kMostTolerance = 1300.0F;

HWY_INLINE FloatLanes floats_at(const std::uint16_t* words) {
  return hn::ConvertTo(Floats(), hn::PromoteTo(Ints(), hn::LoadU(FewWords(), words)));
}

/// The sums of a row are negative as well.
HWY_INLINE FloatLanes signed_at(const std::uint16_t* words) {
  const auto bits = hn::BitCast(FewSigned(), hn::LoadU(FewWords(), words));
  return hn::ConvertTo(Floats(), hn::PromoteTo(Ints(), bits));
}

HWY_INLINE void store_words(FloatLanes values, std::uint16_t* words) {
  hn::StoreU(hn::DemoteTo(FewWords(), hn::NearestInt(values)), FewWords(), words);
}

void find_tolerances(const NeighbourRow& row) {
  constexpr Floats f;
  const std::uint16_t* const z = row.image->row(row.v);
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(f))) {
    const FloatLanes depth = floats_at(z + u);
    const FloatLanes slope =
        hn::Add(hn::Mul(depth, hn::Set(f, row.noise.per_square)), hn::Set(f, row.noise.per_depth));
    const FloatLanes noise = hn::Add(hn::Mul(depth, slope), hn::Set(f, row.noise.least));
    // Less than the reading, so that 0 never agrees.
    const FloatLanes most = hn::Min(hn::Set(f, kMostTolerance), hn::Sub(depth, hn::Set(f, 1.0F)));
    const FloatLanes tolerance = hn::Max(hn::Zero(f), hn::Min(noise, most));
    store_words(hn::Floor(tolerance), row.tolerance + u);
  }
}

/// Counts the readings of a square that agree with its middle, and adds up how much deeper they
/// are, modulo 2^16.
template <int Reach>
HWY_INLINE void gather(const NeighbourRow& row) {
  constexpr Words w;
  const WordLanes one = hn::Set(w, 1);
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(w))) {
    const WordLanes z = hn::LoadU(w, row.image->row(row.v) + u);
    const WordLanes tolerance = hn::LoadU(w, row.tolerance + u);
    WordLanes count = hn::Zero(w), sum = hn::Zero(w);
    for (int dv = -Reach; dv <= Reach; ++dv) {
      const std::uint16_t* const neighbours = row.image->row(row.v + dv) + u;
      for (int du = -Reach; du <= Reach; ++du) {
        const WordLanes a = hn::LoadU(w, neighbours + du);
        const WordLanes apart = hn::Sub(hn::Max(a, z), hn::Min(a, z));
        const auto differs = hn::Gt(apart, tolerance);
        sum = hn::Add(sum, hn::IfThenZeroElse(differs, hn::Sub(a, z)));
        count = hn::Add(count, hn::IfThenZeroElse(differs, one));
      }
    }
    hn::StoreU(count, w, row.count + u);
    hn::StoreU(sum, w, row.sum + u);
  }
}

void supported_row(const NeighbourRow& row, int least) {
  find_tolerances(row);
  gather<1>(row);
  constexpr Words w;
  const WordLanes too_few = hn::Set(w, static_cast<std::uint16_t>(least - 1));
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(w))) {
    const auto is_kept = hn::Gt(hn::LoadU(w, row.count + u), too_few);
    const WordLanes z = hn::LoadU(w, row.image->row(row.v) + u);
    hn::StoreU(hn::IfThenElseZero(is_kept, z), w, row.result + u);
  }
}

void averaged_row(const NeighbourRow& row) {
  find_tolerances(row);
  gather<2>(row);
  constexpr Floats f;
  const std::uint16_t* const z = row.image->row(row.v);
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(f))) {
    // Where there is no reading, those that have none agree, and their sum is 0.
    const FloatLanes count = hn::Max(floats_at(row.count + u), hn::Set(f, 1.0F));
    const FloatLanes deeper = hn::Div(signed_at(row.sum + u), count);
    store_words(hn::Add(floats_at(z + u), deeper), row.result + u);
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(supported_row);
HWY_EXPORT(averaged_row);

NoiseTolerance noise_tolerance(const ConditionedDepth& depth) {
  constexpr float kDeviations = 3.0F * 1.41421356F;
  return {1.0F, 0.01F, kDeviations * depth.noise_per_m * depth.unit_m};
}

template <class MakeRow>
void Neighbours::replace_rows(ConditionedDepth& depth, MakeRow make_row) {
  image_.take(depth.raw);
  const std::size_t room = static_cast<std::size_t>(depth.raw.width()) + BorderedImage::kSlack;
  for (auto* buffer : {&tolerance_, &count_, &sum_, &result_}) buffer->resize(room);
  NeighbourRow row{.image = &image_,
                   .v = 0,
                   .width = depth.raw.width(),
                   .noise = noise_tolerance(depth),
                   .tolerance = tolerance_.data(),
                   .count = count_.data(),
                   .sum = sum_.data(),
                   .result = result_.data()};
  for (; row.v < depth.raw.height(); ++row.v) {
    make_row(row);
    std::ranges::copy_n(result_.begin(), row.width, depth.raw.row(row.v).begin());
  }
}

void Neighbours::keep_supported(ConditionedDepth& depth, int least) {
  replace_rows(depth, [least](const NeighbourRow& row) {
    HWY_DYNAMIC_DISPATCH(supported_row)(row, least);
  });
}

void Neighbours::average(ConditionedDepth& depth) {
  replace_rows(depth, [](const NeighbourRow& row) { HWY_DYNAMIC_DISPATCH(averaged_row)(row); });
}

void BorderedImage::take(const Image<std::uint16_t>& image) {
  const auto border = static_cast<std::size_t>(border_);
  if (image.width() != width_ || image.height() != height_) {
    width_ = image.width();
    height_ = image.height();
    stride_ = static_cast<std::size_t>(width_) + 2 * border + kSlack;
    pixels_.assign(stride_ * (static_cast<std::size_t>(height_) + 2 * border), 0);
  }
  for (int v = 0; v < image.height(); ++v) {
    std::ranges::copy(image.row(v),
                      &pixels_[(static_cast<std::size_t>(v) + border) * stride_ + border]);
  }
}

}  // namespace swiftlet
#endif
