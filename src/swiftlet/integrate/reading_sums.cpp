// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/reading_sums.hpp"

#include <algorithm>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/reading_sums.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet {
namespace HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// Eight pixels at a time: most runs are shorter than that.
using Floats = hn::CappedTag<float, 8>;
using Ints = hn::RebindToSigned<Floats>;
using Raws = hn::Rebind<std::uint16_t, Floats>;
using FloatLanes = hn::Vec<Floats>;
using IntLanes = hn::Vec<Ints>;

/// Whether the ray that ends at depth z_end enters the cell through one of its slabs by then. No
/// MulAdd: fused and not fused are different bits.
HWY_INLINE hn::Mask<Floats> is_entered(const ReadingQuery& q, std::size_t axis, FloatLanes u,
                                       float v, FloatLanes z_end) {
  constexpr Floats f;
  const FloatLanes in_row = hn::Set(f, q.origin[axis] + q.per_v[axis] * v);
  const FloatLanes direction = hn::Add(in_row, hn::Mul(u, hn::Set(f, q.per_u[axis])));
  return hn::Ge(hn::Mul(z_end, direction), hn::Set(f, q.near[axis]));
}

HWY_INLINE IntLanes tabulated(const ReadingQuery& q, IntLanes raw, FloatLanes gap) {
  constexpr Floats f;
  constexpr Ints i;
  const IntLanes row = hn::ShiftRightSame(raw, q.row_shift);
  const FloatLanes per_m = hn::GatherIndex(f, q.columns_per_m, row);
  const FloatLanes place = hn::Add(hn::Mul(gap, per_m), hn::Set(f, q.zero_column));
  const FloatLanes column = hn::Min(hn::Max(place, hn::Zero(f)), hn::Set(f, q.last_column));
  const IntLanes index = hn::Add(hn::Mul(row, hn::Set(i, q.row_length)), hn::ConvertTo(i, column));
  return hn::GatherIndex(i, q.log_odds, index);
}

HWY_INLINE IntLanes evidence(const ReadingQuery& q, hn::Vec<Raws> raw16, FloatLanes u, float v) {
  constexpr Floats f;
  constexpr Ints i;
  const IntLanes raw = hn::PromoteTo(i, raw16);
  const FloatLanes z_reading = hn::Mul(hn::ConvertTo(f, raw), hn::Set(f, q.unit));
  const FloatLanes reach = hn::Mul(hn::Mul(z_reading, z_reading), hn::Set(f, q.three_sigma_per_z2));
  const FloatLanes z_end = hn::Add(z_reading, reach);

  const FloatLanes offset = hn::Sub(hn::Set(f, q.z), z_reading);
  const FloatLanes outside = hn::Sub(hn::Abs(offset), hn::Set(f, q.half_voxel));
  const FloatLanes gap = hn::CopySign(hn::Max(outside, hn::Zero(f)), offset);

  const auto reaches =
      hn::And(is_entered(q, 0, u, v, z_end),
              hn::And(is_entered(q, 1, u, v, z_end), is_entered(q, 2, u, v, z_end)));
  const auto counts = hn::And(reaches, hn::Gt(z_reading, hn::Zero(f)));

  // Most readings are far from the cell or in it, near enough for the model's upper limit: no
  // table.
  const auto is_free = hn::Lt(gap, hn::Mul(reach, hn::Set(f, -q.clear_per_reach)));
  const auto is_behind = hn::Gt(gap, reach);
  const auto is_at = hn::And(hn::Le(outside, hn::Zero(f)), hn::Le(z_reading, hn::Set(f, q.sure_z)));
  const auto is_plain = hn::Or(is_free, hn::Or(is_behind, is_at));
  IntLanes value =
      hn::IfThenElse(hn::RebindMask(i, is_free), hn::Set(i, q.free),
                     hn::IfThenElseZero(hn::RebindMask(i, is_at), hn::Set(i, q.at_reading)));
  const auto is_open = hn::AndNot(is_plain, counts);
  if (!hn::AllFalse(f, is_open))
    value = hn::IfThenElse(hn::RebindMask(i, is_open), tabulated(q, raw, gap), value);
  return hn::IfThenElseZero(hn::RebindMask(i, counts), value);
}

std::int32_t sum_over(const PixelRun* runs, std::size_t run_count, const ReadingQuery& q) {
  constexpr Floats f;
  constexpr Ints i;
  constexpr Raws r;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(f));
  IntLanes sum = hn::Zero(i);
  for (std::size_t k = 0; k < run_count; ++k) {
    const PixelRun& run = runs[k];
    for (std::int32_t first = 0; first < run.count; first += lanes) {
      const std::uint16_t* from = run.readings + first;
      HWY_ALIGN std::uint16_t tail[8] = {};
      if (q.image_end - from < lanes) {
        std::copy(from, q.image_end, tail);
        from = tail;
      }
      const auto left = static_cast<std::size_t>(run.count - first);
      const auto is_in_run = hn::FirstN(r, left);
      const auto raw = hn::IfThenElseZero(is_in_run, hn::LoadU(r, from));
      const FloatLanes u = hn::Iota(f, run.u + static_cast<float>(first));
      sum = hn::Add(sum, evidence(q, raw, u, run.v));
    }
  }
  return hn::GetLane(hn::SumOfLanes(i, sum));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace swiftlet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(sum_over);

std::int32_t sum_readings(std::span<const PixelRun> runs, const ReadingQuery& query) {
  return HWY_DYNAMIC_DISPATCH(sum_over)(runs.data(), runs.size(), query);
}

}  // namespace swiftlet
#endif
