// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/range_image_intersector.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/projective/range_image_intersector.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/image/float_lanes_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

using Mask = hn::Mask<Floats>;

/// Bounding boxes in camera axes [m].
struct Boxes {
  FloatLanes x, y, z_near, z_far;
  float half_x, half_y;
};

/// Rectangles of the image. floor() of a place is its pixel.
struct Rectangles {
  FloatLanes u0, v0, u1, v1;
};

/// Readings of a rectangle.
struct ReadingRange {
  IntLanes nearest, farthest;
  IntLanes gaps;  // not 0 where a pixel has no reading
};

/// Whether any of a box that the camera's plane may cut lies between the four sides of the view.
HWY_INLINE Mask meets_frustum(const ViewParams& view, const Boxes& b) {
  constexpr Floats f;
  const FloatLanes zero = hn::Zero(f);
  const auto place = [&](FloatLanes x, float side, float focal, float offset) {
    return hn::Add(hn::Mul(hn::Set(f, focal), hn::Add(x, hn::Set(f, side))),
                   hn::Mul(hn::Set(f, offset), b.z_far));
  };
  const auto is_in_u =
      hn::And(hn::Ge(place(b.x, b.half_x, view.fx, view.u_offset), zero),
              hn::Le(place(b.x, -b.half_x, view.fx, view.u_offset - view.width), zero));
  const auto is_in_v =
      hn::And(hn::Ge(place(b.y, b.half_y, view.fy, view.v_offset), zero),
              hn::Le(place(b.y, -b.half_y, view.fy, view.v_offset - view.height), zero));
  return hn::And(hn::Gt(b.z_far, zero), hn::And(is_in_u, is_in_v));
}

/// Bounds of the boxes' images. REQUIRES: z_near > 0.
HWY_INLINE Rectangles image_of(const ViewParams& view, const Boxes& b) {
  constexpr Floats f;
  const FloatLanes one = hn::Set(f, 1.0F), zero = hn::Zero(f);
  const FloatLanes per_near = hn::Div(one, b.z_near), per_far = hn::Div(one, b.z_far);
  const auto place = [&](FloatLanes edge, hn::Mask<Floats> is_outward, float focal, float offset) {
    const FloatLanes slope = hn::Mul(edge, hn::IfThenElse(is_outward, per_near, per_far));
    return hn::Add(hn::Mul(hn::Set(f, focal), slope), hn::Set(f, offset));
  };
  const FloatLanes left = hn::Sub(b.x, hn::Set(f, b.half_x));
  const FloatLanes right = hn::Add(b.x, hn::Set(f, b.half_x));
  const FloatLanes top = hn::Sub(b.y, hn::Set(f, b.half_y));
  const FloatLanes bottom = hn::Add(b.y, hn::Set(f, b.half_y));
  return {place(left, hn::Lt(left, zero), view.fx, view.u_offset),
          place(top, hn::Lt(top, zero), view.fy, view.v_offset),
          place(right, hn::Gt(right, zero), view.fx, view.u_offset),
          place(bottom, hn::Gt(bottom, zero), view.fy, view.v_offset)};
}

HWY_INLINE IntLanes pixel_of(FloatLanes place, float size) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes inside = hn::Min(hn::Max(place, hn::Zero(f)), hn::Set(f, size - 1.0F));
  return hn::ConvertTo(i, inside);
}

/// All readings of a rectangle or of a little more: it is rounded outwards to whole tiles of the
/// level whose tiles are at most as wide as it is, and more than half as wide; of one that is
/// `finer` by so many levels.
HWY_INLINE ReadingRange range_of(const ViewParams& view, const DepthRangeTiles& tiles,
                                 const Rectangles& r, int finer) {
  constexpr Floats f;
  constexpr Ints i;
  constexpr hn::RebindToUnsigned<Ints> n;
  const IntLanes u0 = pixel_of(r.u0, view.width), u1 = pixel_of(r.u1, view.width);
  const IntLanes v0 = pixel_of(r.v0, view.height), v1 = pixel_of(r.v1, view.height);
  const IntLanes longest = hn::Add(hn::Max(hn::Sub(u1, u0), hn::Sub(v1, v0)), hn::Set(i, 1));
  // The exponent of a float is the logarithm of a whole number.
  const IntLanes exponent = hn::ShiftRight<23>(hn::BitCast(i, hn::ConvertTo(f, longest)));
  const IntLanes finest = hn::Set(i, 127 + DepthRangePyramid::kTileShift + finer);
  const IntLanes level =
      hn::Min(hn::Max(hn::Sub(exponent, finest), hn::Zero(i)), hn::Set(i, tiles.levels - 1));
  const IntLanes shift = hn::Add(level, hn::Set(i, DepthRangePyramid::kTileShift));
  const IntLanes x0 = hn::Shr(u0, shift), x1 = hn::Shr(u1, shift);
  const IntLanes y0 = hn::Shr(v0, shift), y1 = hn::Shr(v1, shift);
  const IntLanes first = hn::GatherIndex(i, tiles.first.data(), level);
  const IntLanes width = hn::GatherIndex(i, tiles.width.data(), level);

  ReadingRange all{hn::Set(i, 0xffff), hn::Zero(i), hn::Zero(i)};
  for (int dy = 0; dy == 0 || !hn::AllTrue(i, hn::Gt(hn::Add(y0, hn::Set(i, dy)), y1)); ++dy) {
    const IntLanes y = hn::Min(hn::Add(y0, hn::Set(i, dy)), y1);
    const IntLanes row = hn::Add(first, hn::Mul(y, width));
    for (int dx = 0; dx == 0 || !hn::AllTrue(i, hn::Gt(hn::Add(x0, hn::Set(i, dx)), x1)); ++dx) {
      const IntLanes x = hn::Min(hn::Add(x0, hn::Set(i, dx)), x1);
      const IntLanes tile = hn::GatherIndex(i, tiles.words, hn::Add(row, x));
      const IntLanes farthest = hn::BitCast(i, hn::ShiftRight<16>(hn::BitCast(n, tile)));
      all.nearest = hn::Min(all.nearest, hn::And(tile, hn::Set(i, 0xfffe)));
      all.farthest = hn::Max(all.farthest, farthest);
      all.gaps = hn::Or(all.gaps, hn::And(tile, hn::Set(i, DepthRangePyramid::kHasGaps)));
    }
  }
  return all;
}

/// Readings at the depth z [m] plus so many of their deviations.
HWY_INLINE FloatLanes depth_and_sigmas(const KernelParams& params, IntLanes raw, float sigmas) {
  constexpr Floats f;
  const FloatLanes z = hn::Mul(hn::ConvertTo(f, raw), hn::Set(f, params.unit_m));
  return hn::Add(z, hn::Mul(hn::Mul(z, z), hn::Set(f, sigmas * params.sigma_per_z2)));
}

HWY_INLINE IntLanes types_of(const KernelParams& params, const DepthRangeTiles& tiles, Boxes b) {
  constexpr Floats f;
  constexpr Ints i;
  const auto type = [](UpdateType v) { return hn::Set(Ints(), static_cast<std::int32_t>(v)); };
  const IntLanes nothing = type(UpdateType::kUnobserved);
  const FloatLanes closest = hn::Set(f, 0.5F * params.voxel_m);
  const auto is_close = hn::Lt(b.z_near, closest);
  const IntLanes close = hn::IfThenElse(hn::RebindMask(i, meets_frustum(params, b)),
                                        type(UpdateType::kPossiblyOccupied), nothing);
  if (hn::AllTrue(f, is_close)) return close;
  b.z_near = hn::Max(b.z_near, closest);
  b.z_far = hn::Max(b.z_far, closest);

  const Rectangles r = image_of(params, b);
  const FloatLanes zero = hn::Zero(f);
  const FloatLanes width = hn::Set(f, params.width), height = hn::Set(f, params.height);
  const auto meets_image = hn::And(hn::And(hn::Ge(r.u1, zero), hn::Ge(r.v1, zero)),
                                   hn::And(hn::Le(r.u0, width), hn::Le(r.v0, height)));
  const auto is_inside = hn::And(hn::And(hn::Ge(r.u0, zero), hn::Ge(r.v0, zero)),
                                 hn::And(hn::Le(r.u1, width), hn::Le(r.v1, height)));
  const ReadingRange readings = range_of(params, tiles, r, 0);

  const FloatLanes reach = depth_and_sigmas(params, readings.farthest, params.model.reach_sigma);
  // Concave in the depth of the reading, so the smallest is at an end of the range.
  const FloatLanes before =
      hn::Min(depth_and_sigmas(params, readings.nearest, -params.model.in_front_sigma),
              depth_and_sigmas(params, readings.farthest, -params.model.in_front_sigma));
  const auto is_hidden = hn::Gt(hn::Sub(b.z_near, hn::Set(f, params.model.hidden_m)), reach);
  const auto is_passed = hn::Lt(hn::Add(b.z_far, hn::Set(f, params.model.passed_m)), before);
  const auto is_clear = hn::Lt(hn::Add(b.z_far, hn::Set(f, params.model.clear_m)), before);
  const auto is_far = hn::Gt(b.z_near, hn::Set(f, kNearVoxels * params.voxel_m));
  const auto has_readings = hn::RebindMask(f, hn::Gt(readings.farthest, hn::Zero(i)));
  const auto has_all = hn::RebindMask(f, hn::Eq(readings.gaps, hn::Zero(i)));

  const auto says_something = hn::AndNot(is_hidden, hn::And(meets_image, has_readings));
  const auto is_whole = hn::And(hn::And(has_all, is_inside), hn::And(is_far, is_clear));
  const IntLanes passed = hn::IfThenElse(hn::RebindMask(i, is_whole), type(UpdateType::kFree),
                                         type(UpdateType::kFreeOrUnobserved));
  const IntLanes seen =
      hn::IfThenElse(hn::RebindMask(i, is_passed), passed, type(UpdateType::kPossiblyOccupied));
  return hn::IfThenElse(hn::RebindMask(i, is_close), close,
                        hn::IfThenElse(hn::RebindMask(i, says_something), seen, nothing));
}

void intersect(const KernelParams& params, const DepthRangeTiles& tiles, const CubeBatch& cubes,
               UpdateTypes& types) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes half_z = hn::Set(f, cubes.half_camera[2]);
  HWY_ALIGN std::int32_t lanes[CubeBatch::kMost];
  for (std::size_t k = 0; k < cubes.count; k += hn::Lanes(f)) {
    const FloatLanes z = hn::Load(f, &cubes.z[k]);
    const Boxes boxes{hn::Load(f, &cubes.x[k]), hn::Load(f, &cubes.y[k]), hn::Sub(z, half_z),
                      hn::Add(z, half_z),       cubes.half_camera[0],     cubes.half_camera[1]};
    hn::Store(types_of(params, tiles, boxes), i, lanes + k);
  }
  for (std::size_t k = 0; k < cubes.count; ++k) types[k] = static_cast<UpdateType>(lanes[k]);
}

void find_ranges(const ViewParams& view, const DepthRangeTiles& tiles, int finer,
                 const CubeBatch& cubes, ImageRanges& ranges) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes half_z = hn::Set(f, cubes.half_camera[2]), zero = hn::Zero(f);
  const FloatLanes closest = hn::Add(half_z, hn::Set(f, 0.25F * view.voxel_m));
  HWY_ALIGN std::int32_t in_view[CubeBatch::kMost];
  HWY_ALIGN std::int32_t gaps[CubeBatch::kMost];
  for (std::size_t k = 0; k < cubes.count; k += hn::Lanes(f)) {
    // Lanes of no cube may lie anywhere.
    const FloatLanes z = hn::Max(hn::Load(f, &cubes.z[k]), closest);
    const Boxes boxes{hn::Load(f, &cubes.x[k]), hn::Load(f, &cubes.y[k]), hn::Sub(z, half_z),
                      hn::Add(z, half_z),       cubes.half_camera[0],     cubes.half_camera[1]};
    const Rectangles r = image_of(view, boxes);
    const auto meets_image = hn::And(
        hn::And(hn::Ge(r.u1, zero), hn::Ge(r.v1, zero)),
        hn::And(hn::Lt(r.u0, hn::Set(f, view.width)), hn::Lt(r.v0, hn::Set(f, view.height))));
    const ReadingRange range = range_of(view, tiles, r, finer);
    hn::StoreU(range.nearest, i, &ranges.nearest[k]);
    hn::StoreU(range.farthest, i, &ranges.farthest[k]);
    hn::Store(range.gaps, i, gaps + k);
    hn::Store(hn::VecFromMask(i, hn::RebindMask(i, meets_image)), i, in_view + k);
  }
  for (std::size_t k = 0; k < cubes.count; ++k) {
    ranges.is_in_view[k] = in_view[k] != 0;
    ranges.has_gaps[k] = gaps[k] != 0;
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(intersect);
HWY_EXPORT(find_ranges);

void find_image_ranges(const ViewParams& view, const DepthRangeTiles& tiles, int finer,
                       const CubeBatch& cubes, ImageRanges& ranges) {
  HWY_DYNAMIC_DISPATCH(find_ranges)(view, tiles, finer, cubes, ranges);
}

void intersect_cubes(const KernelParams& params, const DepthRangeTiles& tiles,
                     const CubeBatch& cubes, UpdateTypes& types) {
  HWY_DYNAMIC_DISPATCH(intersect)(params, tiles, cubes, types);
}

}  // namespace swiftlet
#endif
