// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/neighbour_kernels.hpp"

#include <algorithm>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/preprocess/neighbour_kernels.cpp"
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

/// At most so much, so that 25 times twice of it are less than 2^16.
constexpr float kMostTolerance = 1300.0F;

HWY_INLINE FloatLanes floats_at(const std::uint16_t* words) {
  return hn::ConvertTo(Floats(), hn::PromoteTo(Ints(), hn::LoadU(FewWords(), words)));
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
    // What agrees lies between 1 and 2^16 - 1, so that 0 never does.
    const FloatLanes inside =
        hn::Min(hn::Sub(depth, hn::Set(f, 1.0F)), hn::Sub(hn::Set(f, 65535.0F), depth));
    const FloatLanes most = hn::Min(hn::Set(f, kMostTolerance), inside);
    const FloatLanes tolerance = hn::Max(hn::Zero(f), hn::Min(noise, most));
    store_words(hn::Floor(tolerance), row.tolerance + u);
  }
}

/// Of the readings of a square that agree with its middle: how many there are of the 3 x 3 and in
/// all, and the sum of their depths from the least that agrees on.
struct Agreement {
  WordLanes near, all, sum;

  template <int Reach>
  HWY_INLINE static Agreement around(const NeighbourRow& row, int u, WordLanes z) {
    constexpr Words w;
    const WordLanes one = hn::Set(w, 1), tolerance = hn::LoadU(w, row.tolerance + u);
    const WordLanes least = hn::Sub(z, tolerance), reach = hn::Add(tolerance, tolerance);
    Agreement a{hn::Zero(w), hn::Zero(w), hn::Zero(w)};
    for (int dv = -Reach; dv <= Reach; ++dv) {
      const std::uint16_t* const neighbours = row.image->row(row.v + dv) + u;
      for (int du = -Reach; du <= Reach; ++du) {
        const WordLanes deeper = hn::Sub(hn::LoadU(w, neighbours + du), least);  // modulo 2^16
        const auto differs = hn::Gt(deeper, reach);
        const WordLanes count = hn::IfThenZeroElse(differs, one);
        if (dv * dv <= 1 && du * du <= 1) a.near = hn::Add(a.near, count);
        if constexpr (Reach == 1) continue;
        a.all = hn::Add(a.all, count);
        a.sum = hn::Add(a.sum, hn::IfThenZeroElse(differs, deeper));
      }
    }
    return a;
  }
};

HWY_INLINE hn::Mask<Words> is_supported(WordLanes near) {
  return hn::Gt(near, hn::Set(Words(), Neighbours::kLeast - 1));
}

void supported_row(const NeighbourRow& row) {
  constexpr Words w;
  find_tolerances(row);
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(w))) {
    const WordLanes z = hn::LoadU(w, row.image->row(row.v) + u);
    const auto a = Agreement::around<1>(row, u, z);
    hn::StoreU(hn::IfThenElseZero(is_supported(a.near), z), w, row.result + u);
  }
}

void averaged_row(const NeighbourRow& row) {
  constexpr Words w;
  find_tolerances(row);
  const std::uint16_t* const z_of = row.image->row(row.v);
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(w))) {
    const WordLanes z = hn::LoadU(w, z_of + u);
    const auto a = Agreement::around<2>(row, u, z);
    hn::StoreU(hn::IfThenElseZero(is_supported(a.near), a.all), w, row.count + u);
    hn::StoreU(a.sum, w, row.sum + u);
  }
  constexpr Floats f;
  for (int u = 0; u < row.width; u += static_cast<int>(hn::Lanes(f))) {
    // Where there is no reading, those that have none agree, and their sum is 0.
    const FloatLanes count = floats_at(row.count + u);
    const auto is_kept = hn::Gt(count, hn::Zero(f));
    const FloatLanes least = hn::Sub(floats_at(z_of + u), floats_at(row.tolerance + u));
    const FloatLanes mean = hn::Add(least, hn::Div(floats_at(row.sum + u), count));
    store_words(hn::IfThenElseZero(is_kept, mean), row.result + u);
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(supported_row);
HWY_EXPORT(averaged_row);

NoiseTolerance noise_tolerance(const PreprocessedDepth& depth) {
  constexpr float kDeviations = 3.0F * 1.41421356F;
  return {1.0F, 0.01F, kDeviations * depth.sigma_per_z2 * depth.unit_m};
}

template <class MakeRow>
void Neighbours::replace_rows(PreprocessedDepth& depth, MakeRow make_row) {
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

void Neighbours::keep_supported(PreprocessedDepth& depth) {
  replace_rows(depth, [](const NeighbourRow& row) { HWY_DYNAMIC_DISPATCH(supported_row)(row); });
}

void Neighbours::average(PreprocessedDepth& depth) {
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
