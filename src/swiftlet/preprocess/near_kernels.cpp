// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/near_kernels.hpp"

#include <cstddef>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/preprocess/near_kernels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Raws = hn::ScalableTag<std::uint16_t>;
using OneRaw = hn::CappedTag<std::uint16_t, 1>;

template <class D>
HWY_INLINE void add_readings(D d, const std::uint16_t* raw, std::uint16_t number,
                             std::uint16_t* nearest_less_1, std::uint16_t* row,
                             std::uint16_t* valid) {
  const auto one = hn::Set(d, 1), z = hn::LoadU(d, raw), known = hn::LoadU(d, nearest_less_1);
  const auto less_1 = hn::Sub(z, one);
  const auto is_nearer = hn::Lt(less_1, known);
  hn::StoreU(hn::IfThenElse(is_nearer, hn::Set(d, number), hn::LoadU(d, row)), d, row);
  hn::StoreU(hn::Min(less_1, known), d, nearest_less_1);
  hn::StoreU(hn::Add(hn::LoadU(d, valid), hn::Min(z, one)), d, valid);
}

template <class D>
HWY_INLINE void add_support(D d, const std::uint16_t* raw, const std::uint16_t* limit,
                            std::uint16_t* support) {
  const auto one = hn::Set(d, 1);
  // As above, 0 becomes too large a number.
  const auto is_support = hn::Lt(hn::Sub(hn::LoadU(d, raw), one), hn::LoadU(d, limit));
  hn::StoreU(hn::Add(hn::LoadU(d, support), hn::IfThenElseZero(is_support, one)), d, support);
}

void readings(const std::uint16_t* raw, std::size_t width, std::uint16_t number,
              std::uint16_t* nearest_less_1, std::uint16_t* row, std::uint16_t* valid) {
  std::size_t u = 0;
  for (; u + hn::Lanes(Raws()) <= width; u += hn::Lanes(Raws()))
    add_readings(Raws(), raw + u, number, nearest_less_1 + u, row + u, valid + u);
  for (; u < width; ++u)
    add_readings(OneRaw(), raw + u, number, nearest_less_1 + u, row + u, valid + u);
}

void support_of(const std::uint16_t* raw, std::size_t width, const std::uint16_t* limit,
                std::uint16_t* support) {
  std::size_t u = 0;
  for (; u + hn::Lanes(Raws()) <= width; u += hn::Lanes(Raws()))
    add_support(Raws(), raw + u, limit + u, support + u);
  for (; u < width; ++u) add_support(OneRaw(), raw + u, limit + u, support + u);
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(readings);
HWY_EXPORT(support_of);

void add_row_of_readings(std::span<const std::uint16_t> raw, std::uint16_t number,
                         std::uint16_t* nearest_less_1, std::uint16_t* row, std::uint16_t* valid) {
  HWY_DYNAMIC_DISPATCH(readings)(raw.data(), raw.size(), number, nearest_less_1, row, valid);
}

void add_row_of_support(std::span<const std::uint16_t> raw, const std::uint16_t* limit,
                        std::uint16_t* support) {
  HWY_DYNAMIC_DISPATCH(support_of)(raw.data(), raw.size(), limit, support);
}

}  // namespace swiftlet
#endif
