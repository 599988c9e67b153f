// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/cube_judge.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/projective/cube_judge.cpp"
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
struct Readings {
  IntLanes nearest, farthest;
  IntLanes gaps;  // not 0 where a pixel has no reading
};

/// Whether any of a box that the camera's plane may cut lies between the four sides of the view.
HWY_INLINE Mask meets_frustum(const FrameInView& frame, const Boxes& b) {
  constexpr Floats f;
  const FloatLanes zero = hn::Zero(f);
  const auto place = [&](FloatLanes x, float side, float focal, float offset) {
    return hn::Add(hn::Mul(hn::Set(f, focal), hn::Add(x, hn::Set(f, side))),
                   hn::Mul(hn::Set(f, offset), b.z_far));
  };
  const auto is_in_u =
      hn::And(hn::Ge(place(b.x, b.half_x, frame.fx, frame.u_offset), zero),
              hn::Le(place(b.x, -b.half_x, frame.fx, frame.u_offset - frame.width), zero));
  const auto is_in_v =
      hn::And(hn::Ge(place(b.y, b.half_y, frame.fy, frame.v_offset), zero),
              hn::Le(place(b.y, -b.half_y, frame.fy, frame.v_offset - frame.height), zero));
  return hn::And(hn::Gt(b.z_far, zero), hn::And(is_in_u, is_in_v));
}

/// Bounds of the boxes' images. REQUIRES: z_near > 0.
HWY_INLINE Rectangles image_of(const FrameInView& frame, const Boxes& b) {
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
  return {place(left, hn::Lt(left, zero), frame.fx, frame.u_offset),
          place(top, hn::Lt(top, zero), frame.fy, frame.v_offset),
          place(right, hn::Gt(right, zero), frame.fx, frame.u_offset),
          place(bottom, hn::Gt(bottom, zero), frame.fy, frame.v_offset)};
}

HWY_INLINE IntLanes pixel_of(FloatLanes place, float size) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes inside = hn::Min(hn::Max(place, hn::Zero(f)), hn::Set(f, size - 1.0F));
  return hn::ConvertTo(i, inside);
}

/// All readings of a rectangle or of a little more: it is rounded outwards to whole tiles of the
/// level whose tiles are at most as wide as it is, and more than half as wide.
HWY_INLINE Readings readings_of(const FrameInView& frame, const DepthRangeTiles& tiles,
                                const Rectangles& r) {
  constexpr Floats f;
  constexpr Ints i;
  constexpr hn::RebindToUnsigned<Ints> n;
  const IntLanes u0 = pixel_of(r.u0, frame.width), u1 = pixel_of(r.u1, frame.width);
  const IntLanes v0 = pixel_of(r.v0, frame.height), v1 = pixel_of(r.v1, frame.height);
  const IntLanes longest = hn::Add(hn::Max(hn::Sub(u1, u0), hn::Sub(v1, v0)), hn::Set(i, 1));
  // The exponent of a float is the logarithm of a whole number.
  const IntLanes exponent = hn::ShiftRight<23>(hn::BitCast(i, hn::ConvertTo(f, longest)));
  const IntLanes finest = hn::Set(i, 127 + DepthRangePyramid::kTileShift);
  const IntLanes level =
      hn::Min(hn::Max(hn::Sub(exponent, finest), hn::Zero(i)), hn::Set(i, tiles.levels - 1));
  const IntLanes shift = hn::Add(level, hn::Set(i, DepthRangePyramid::kTileShift));
  const IntLanes x0 = hn::Shr(u0, shift), x1 = hn::Shr(u1, shift);
  const IntLanes y0 = hn::Shr(v0, shift), y1 = hn::Shr(v1, shift);
  const IntLanes first = hn::GatherIndex(i, tiles.first.data(), level);
  const IntLanes width = hn::GatherIndex(i, tiles.width.data(), level);

  Readings all{hn::Set(i, 0xffff), hn::Zero(i), hn::Zero(i)};
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
HWY_INLINE FloatLanes depth_and_sigmas(const FrameInView& frame, IntLanes raw, float sigmas) {
  constexpr Floats f;
  const FloatLanes z = hn::Mul(hn::ConvertTo(f, raw), hn::Set(f, frame.unit_m));
  return hn::Add(z, hn::Mul(hn::Mul(z, z), hn::Set(f, sigmas * frame.sigma_per_z2)));
}

HWY_INLINE IntLanes verdicts_of(const FrameInView& frame, const DepthRangeTiles& tiles, Boxes b) {
  constexpr Floats f;
  constexpr Ints i;
  const auto verdict = [](Verdict v) { return hn::Set(Ints(), static_cast<std::int32_t>(v)); };
  const IntLanes nothing = verdict(Verdict::kNothing);
  const FloatLanes closest = hn::Set(f, 0.5F * frame.voxel_m);
  const auto is_close = hn::Lt(b.z_near, closest);
  const IntLanes close =
      hn::IfThenElse(hn::RebindMask(i, meets_frustum(frame, b)), verdict(Verdict::kMixed), nothing);
  if (hn::AllTrue(f, is_close)) return close;
  b.z_near = hn::Max(b.z_near, closest);
  b.z_far = hn::Max(b.z_far, closest);

  const Rectangles r = image_of(frame, b);
  const FloatLanes zero = hn::Zero(f);
  const FloatLanes width = hn::Set(f, frame.width), height = hn::Set(f, frame.height);
  const auto meets_image = hn::And(hn::And(hn::Ge(r.u1, zero), hn::Ge(r.v1, zero)),
                                   hn::And(hn::Le(r.u0, width), hn::Le(r.v0, height)));
  const auto is_inside = hn::And(hn::And(hn::Ge(r.u0, zero), hn::Ge(r.v0, zero)),
                                 hn::And(hn::Le(r.u1, width), hn::Le(r.v1, height)));
  const Readings readings = readings_of(frame, tiles, r);

  const FloatLanes reach = depth_and_sigmas(frame, readings.farthest, frame.reach_sigma);
  // Concave in the depth of the reading, so the smallest is at an end of the range.
  const FloatLanes before =
      hn::Min(depth_and_sigmas(frame, readings.nearest, -EvidenceTable::kInFrontSigma),
              depth_and_sigmas(frame, readings.farthest, -EvidenceTable::kInFrontSigma));
  const auto is_hidden = hn::Gt(hn::Sub(b.z_near, hn::Set(f, frame.hidden_m)), reach);
  const auto is_passed = hn::Lt(hn::Add(b.z_far, hn::Set(f, frame.passed_m)), before);
  const auto is_clear = hn::Lt(hn::Add(b.z_far, hn::Set(f, frame.clear_m)), before);
  const auto is_far = hn::Gt(b.z_near, hn::Set(f, kNearCells * frame.voxel_m));
  const auto has_readings = hn::RebindMask(f, hn::Gt(readings.farthest, hn::Zero(i)));
  const auto has_all = hn::RebindMask(f, hn::Eq(readings.gaps, hn::Zero(i)));

  const auto says_something = hn::AndNot(is_hidden, hn::And(meets_image, has_readings));
  const auto is_whole = hn::And(hn::And(has_all, is_inside), hn::And(is_far, is_clear));
  const IntLanes passed =
      hn::IfThenElse(hn::RebindMask(i, is_whole), verdict(Verdict::kFree), verdict(Verdict::kSeen));
  const IntLanes seen =
      hn::IfThenElse(hn::RebindMask(i, is_passed), passed, verdict(Verdict::kMixed));
  return hn::IfThenElse(hn::RebindMask(i, is_close), close,
                        hn::IfThenElse(hn::RebindMask(i, says_something), seen, nothing));
}

void judge(const FrameInView& frame, const DepthRangeTiles& tiles, const CubeBatch& cubes,
           Verdicts& verdicts) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes half_z = hn::Set(f, cubes.half_camera[2]);
  HWY_ALIGN std::int32_t lanes[CubeBatch::kMost];
  for (std::size_t k = 0; k < cubes.count; k += hn::Lanes(f)) {
    const FloatLanes z = hn::Load(f, &cubes.z[k]);
    const Boxes boxes{hn::Load(f, &cubes.x[k]), hn::Load(f, &cubes.y[k]), hn::Sub(z, half_z),
                      hn::Add(z, half_z),       cubes.half_camera[0],     cubes.half_camera[1]};
    hn::Store(verdicts_of(frame, tiles, boxes), i, lanes + k);
  }
  for (std::size_t k = 0; k < cubes.count; ++k) verdicts[k] = static_cast<Verdict>(lanes[k]);
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(judge);

void judge_cubes(const FrameInView& frame, const DepthRangeTiles& tiles, const CubeBatch& cubes,
                 Verdicts& verdicts) {
  HWY_DYNAMIC_DISPATCH(judge)(frame, tiles, cubes, verdicts);
}

}  // namespace swiftlet
#endif
