// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/image/depth_mean_kernels.hpp"

#include <algorithm>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/image/depth_mean_kernels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/image/float_lanes_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

using Raws = hn::Rebind<std::uint16_t, Floats>;

/// Four parts of each tile: readings, their mean depth [m] and variance.
struct Parts {
  FloatLanes count[4], mean[4], variance[4];

  HWY_INLINE Parts() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

/// Scatter that noise alone makes: in deviations of a reading, of all but odd tiles.
constexpr float kNoiseScatter = 1.6F;

/// A number in [0, 1) for each lane.
HWY_INLINE FloatLanes draw(std::uint32_t seed, int x) {
  constexpr Floats f;
  constexpr Ints i;
  const IntLanes lane = hn::Iota(i, x);
  IntLanes h = hn::Mul(hn::Add(lane, hn::Set(i, static_cast<std::int32_t>(seed))),
                       hn::Set(i, static_cast<std::int32_t>(0x9E3779B1U)));
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)),
              hn::Set(i, static_cast<std::int32_t>(0x85EBCA77U)));
  h = hn::And(hn::ShiftRight<7>(h), hn::Set(i, 0xffffff));
  return hn::Mul(hn::ConvertTo(f, h), hn::Set(f, 1.0F / 16777216.0F));
}

/// What readings say together, as the low and the high part of a word.
struct EncodedDepth {
  IntLanes code, narrow;

  HWY_INLINE EncodedDepth() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

HWY_INLINE EncodedDepth encode(FloatLanes mean, FloatLanes narrow) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes least = hn::Set(f, 1.0F / 64.0F), most = hn::Set(f, 1024.0F);
  const FloatLanes inverse = hn::Div(hn::Set(f, 1.0F), hn::Min(hn::Max(mean, least), most));
  const IntLanes bits = hn::Add(hn::BitCast(i, inverse), hn::Set(i, DepthMeanTiles::kHalfCode));
  const IntLanes code = hn::Sub(hn::ShiftRight<DepthMeanTiles::kCodeShift>(bits),
                                hn::Set(i, DepthMeanTiles::kFirstCode));
  EncodedDepth encoded;
  encoded.code = hn::Min(code, hn::Set(i, DepthMeanTiles::kCodes - 1));
  encoded.narrow = hn::NearestInt(hn::Mul(narrow, hn::Set(f, DepthMeanTiles::kNarrowest)));
  return encoded;
}

/// Writes one vector of tiles. `part_of(k)` is the encoded of part k.
template <class PartOf>
HWY_INLINE void finish(const Parts& p, const PartOf& part_of, std::ptrdiff_t x,
                       const DepthMeanRow& row) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes one = hn::Set(f, 1.0F);
  const FloatLanes count =
      hn::Add(hn::Add(p.count[0], p.count[1]), hn::Add(p.count[2], p.count[3]));
  const FloatLanes per_count = hn::Div(one, hn::Max(count, one));
  FloatLanes sum = hn::Mul(p.count[0], p.mean[0]);
  for (int k = 1; k < 4; ++k) sum = hn::Add(sum, hn::Mul(p.count[k], p.mean[k]));
  const FloatLanes mean = hn::Mul(sum, per_count);
  FloatLanes scatter = hn::Zero(f);
  for (int k = 0; k < 4; ++k) {
    const FloatLanes off = hn::Sub(p.mean[k], mean);
    scatter = hn::Add(scatter, hn::Mul(p.count[k], hn::Add(p.variance[k], hn::Mul(off, off))));
  }
  const FloatLanes variance = hn::Mul(scatter, per_count);
  hn::StoreU(count, f, row.count + x);
  hn::StoreU(mean, f, row.mean_m + x);
  hn::StoreU(variance, f, row.variance_m2 + x);

  const FloatLanes sigma = hn::Mul(hn::Mul(mean, mean), hn::Set(f, row.sigma_per_z2));
  const FloatLanes sigma2 = hn::Mul(sigma, sigma);
  const FloatLanes deviation2 = hn::Max(hn::Add(sigma2, variance), hn::Set(f, 1e-12F));
  EncodedDepth encoded = encode(mean, hn::Sqrt(hn::Sqrt(hn::Div(sigma2, deviation2))));
  const FloatLanes most = hn::Max(hn::Mul(sigma2, hn::Set(f, kNoiseScatter * kNoiseScatter)),
                                  hn::Set(f, row.most_scatter_m * row.most_scatter_m));
  const auto is_edge = hn::Gt(variance, most);
  if (!hn::AllFalse(f, is_edge)) {
    FloatLanes left = hn::Mul(draw(row.seed, static_cast<int>(x)), count);
    EncodedDepth drawn = part_of(0);
    for (int k = 1; k < 4; ++k) {
      left = hn::Sub(left, p.count[k - 1]);
      const auto is_later =
          hn::RebindMask(i, hn::And(hn::Ge(left, hn::Zero(f)), hn::Gt(p.count[k], hn::Zero(f))));
      const EncodedDepth later = part_of(k);
      drawn.code = hn::IfThenElse(is_later, later.code, drawn.code);
      drawn.narrow = hn::IfThenElse(is_later, later.narrow, drawn.narrow);
    }
    encoded.code = hn::IfThenElse(hn::RebindMask(i, is_edge), drawn.code, encoded.code);
    encoded.narrow = hn::IfThenElse(hn::RebindMask(i, is_edge), drawn.narrow, encoded.narrow);
  }

  // Tiles at the right edge have fewer columns in the image.
  const auto width = static_cast<float>(1 << row.shift);
  const FloatLanes first = hn::Mul(hn::Iota(f, static_cast<float>(x)), hn::Set(f, width));
  const FloatLanes columns =
      hn::Min(hn::Max(hn::Sub(hn::Set(f, static_cast<float>(row.image_width)), first), one),
              hn::Set(f, width));
  const FloatLanes pixels = hn::Mul(columns, hn::Set(f, static_cast<float>(row.pixel_rows)));
  const FloatLanes share = hn::Div(hn::Mul(count, hn::Set(f, DepthMeanTiles::kAll)), pixels);
  const auto high =
      hn::Or(hn::ShiftLeft<16>(hn::NearestInt(share)), hn::ShiftLeft<24>(encoded.narrow));
  hn::StoreU(hn::Or(encoded.code, high), i, row.words + x);
}

/// Tiles from column `x` of the two rows of pixels that begin at `upper` and `lower`.
HWY_INLINE void tiles_of_pixels(const std::uint16_t* upper, const std::uint16_t* lower,
                                std::ptrdiff_t x, const DepthMeanRow& row) {
  constexpr Floats f;
  constexpr Ints i;
  constexpr Raws r;
  const FloatLanes unit = hn::Set(f, row.unit_m), one = hn::Set(f, 1.0F);
  hn::Vec<Raws> raw[4];
  hn::LoadInterleaved2(r, upper, raw[0], raw[1]);
  hn::LoadInterleaved2(r, lower, raw[2], raw[3]);
  Parts parts;
  for (int k = 0; k < 4; ++k) {
    parts.mean[k] = hn::Mul(hn::ConvertTo(f, hn::PromoteTo(i, raw[k])), unit);
    parts.count[k] = hn::IfThenElseZero(hn::Gt(parts.mean[k], hn::Zero(f)), one);
    parts.variance[k] = hn::Zero(f);
  }
  finish(
      parts, [&](int k) { return encode(parts.mean[k], one); }, x, row);
}

void pixels(const std::uint16_t* upper, const std::uint16_t* lower, const DepthMeanRow& row) {
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(Floats()));
  std::ptrdiff_t x = 0;
  for (; 2 * (x + lanes) <= row.image_width; x += lanes)
    tiles_of_pixels(upper + 2 * x, lower + 2 * x, x, row);
  if (x == row.tiles) return;
  // The rest fills no vector: beyond the image there are no readings.
  std::uint16_t ends[2][32] = {};
  std::copy(upper + 2 * x, upper + row.image_width, ends[0]);
  std::copy(lower + 2 * x, lower + row.image_width, ends[1]);
  tiles_of_pixels(ends[0], ends[1], x, row);
}

HWY_INLINE EncodedDepth encoded_in(IntLanes word) {
  constexpr Ints i;
  constexpr hn::RebindToUnsigned<Ints> n;
  EncodedDepth encoded;
  encoded.code = hn::And(word, hn::Set(i, DepthMeanTiles::kCodes - 1));
  encoded.narrow = hn::BitCast(i, hn::ShiftRight<24>(hn::BitCast(n, word)));
  return encoded;
}

void merge(const FinerMeanRow& upper, const FinerMeanRow& lower, const DepthMeanRow& row) {
  constexpr Floats f;
  constexpr Ints i;
  for (std::ptrdiff_t x = 0; x < row.tiles; x += static_cast<std::ptrdiff_t>(hn::Lanes(f))) {
    Parts parts;
    hn::LoadInterleaved2(f, upper.count + 2 * x, parts.count[0], parts.count[1]);
    hn::LoadInterleaved2(f, lower.count + 2 * x, parts.count[2], parts.count[3]);
    hn::LoadInterleaved2(f, upper.mean_m + 2 * x, parts.mean[0], parts.mean[1]);
    hn::LoadInterleaved2(f, lower.mean_m + 2 * x, parts.mean[2], parts.mean[3]);
    hn::LoadInterleaved2(f, upper.variance_m2 + 2 * x, parts.variance[0], parts.variance[1]);
    hn::LoadInterleaved2(f, lower.variance_m2 + 2 * x, parts.variance[2], parts.variance[3]);
    IntLanes words[4];
    hn::LoadInterleaved2(i, upper.words + 2 * x, words[0], words[1]);
    hn::LoadInterleaved2(i, lower.words + 2 * x, words[2], words[3]);
    finish(
        parts, [&](int k) { return encoded_in(words[k]); }, x, row);
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(pixels);
HWY_EXPORT(merge);

void average_pixels(const std::uint16_t* upper, const std::uint16_t* lower,
                    const DepthMeanRow& row) {
  HWY_DYNAMIC_DISPATCH(pixels)(upper, lower, row);
}

void merge_means(const FinerMeanRow& upper, const FinerMeanRow& lower, const DepthMeanRow& row) {
  HWY_DYNAMIC_DISPATCH(merge)(upper, lower, row);
}

}  // namespace swiftlet
#endif
