// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/image/ridge_kernels.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/image/ridge_kernels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Ints = hn::CappedTag<std::int32_t, RidgeTile::kEdge>;
using Floats = hn::RebindToFloat<Ints>;
using Words = hn::Rebind<std::uint16_t, Ints>;
using IntLanes = hn::Vec<Ints>;
using Mask = hn::Mask<Ints>;

HWY_INLINE IntLanes readings_at(const std::uint16_t* pixels) {
  return hn::PromoteTo(Ints(), hn::LoadU(Words(), pixels));
}

/// The farthest whole number that is not clearly behind a reading.
template <class D>
HWY_INLINE hn::Vec<D> far_behind(D i, hn::Vec<D> z, const RidgeLimits& limits) {
  constexpr hn::RebindToFloat<D> f;
  const auto depth = hn::ConvertTo(f, z);
  const auto by_noise = hn::Mul(hn::Mul(hn::Set(f, limits.behind_per_square), depth), depth);
  const auto far = hn::Add(depth, hn::Max(hn::Set(f, limits.least_behind), by_noise));
  return hn::ConvertTo(i, hn::Min(far, hn::Set(f, 65535.0F)));
}

/// Whether neither of two readings blocks the view to what is farther, and one of them is any.
HWY_INLINE Mask is_open(IntLanes a, IntLanes b, IntLanes far) {
  constexpr Ints i;
  const IntLanes none = hn::Zero(i);
  const auto is_past = [&](IntLanes z) { return hn::Or(hn::Eq(z, none), hn::Gt(z, far)); };
  return hn::And(hn::And(is_past(a), is_past(b)), hn::Gt(hn::Or(a, b), none));
}

RidgeBits ridges(const RidgeTile& tile, const RidgeLimits& limits) {
  constexpr Ints i;
  constexpr auto kLanes = static_cast<int>(hn::MaxLanes(Ints()));
  RidgeBits bits{};
  for (int k = 0; k < RidgeTile::kEdge; ++k) {
    const int v = tile.v + k;
    std::uint32_t row = 0;
    for (int first = 0; first < RidgeTile::kEdge; first += kLanes) {
      const auto at = [&](int dv, int du) {
        return readings_at(tile.image->row(v + dv) + tile.u + first + du);
      };
      const IntLanes z = at(0, 0), far = far_behind(i, z, limits);
      const Mask across = is_open(at(0, -tile.reach), at(0, tile.reach), far);
      const Mask along = is_open(at(-tile.reach, 0), at(tile.reach, 0), far);
      const Mask is_ridge = hn::And(hn::Or(across, along), hn::Gt(z, hn::Zero(i)));
      std::uint8_t found[8] = {};
      hn::StoreMaskBits(i, is_ridge, found);
      row |= std::uint32_t{found[0]} << first;
    }
    bits[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(row);
  }
  return bits;
}

std::int32_t far_behind_one(std::int32_t z, const RidgeLimits& limits) {
  constexpr hn::CappedTag<std::int32_t, 1> i;
  return hn::GetLane(far_behind(i, hn::Set(i, z), limits));
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(ridges);
HWY_EXPORT(far_behind_one);

bool may_have_ridge(const DepthRangeTiles& tiles, std::size_t level, int tile_u, int tile_v,
                    const RidgeLimits& limits) {
  const std::int32_t* words = tiles.words + tiles.first[level];
  const int width = tiles.width[level];
  const int height = (tiles.first[level + 1] - tiles.first[level]) / width;
  const auto farthest = [&](int u, int v) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(words[v * width + u]) >> 16U);
  };
  if (farthest(tile_u, tile_v) == 0) return false;  // no reading
  // The nearest reading looks farthest to the side, and needs the least behind it.
  const std::int32_t nearest = words[tile_v * width + tile_u] & 0xfffe;
  const int tile = DepthRangePyramid::kTile << level;
  const int reach = (limits.reach_px(nearest) + tile - 1) / tile;
  const std::int32_t far = HWY_DYNAMIC_DISPATCH(far_behind_one)(nearest, limits);
  for (int u = std::max(0, tile_u - reach); u <= std::min(width - 1, tile_u + reach); ++u) {
    if (farthest(u, tile_v) > far) return true;
  }
  for (int v = std::max(0, tile_v - reach); v <= std::min(height - 1, tile_v + reach); ++v) {
    if (farthest(tile_u, v) > far) return true;
  }
  return false;
}

RidgeBits find_ridges(const RidgeTile& tile, const RidgeLimits& limits) {
  return HWY_DYNAMIC_DISPATCH(ridges)(tile, limits);
}

}  // namespace swiftlet
#endif
