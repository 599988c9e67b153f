// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Vectors of floats, at most 16 in each. Included once for every instruction set, so there is no
// #pragma once but Highway's toggle.
#if defined(SWIFTLET_FLOAT_LANES_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_FLOAT_LANES_PRIVATE
#undef SWIFTLET_FLOAT_LANES_PRIVATE
#else
#define SWIFTLET_FLOAT_LANES_PRIVATE
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// No MulAdd: fused and not fused are different bits.
using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
// On ARM these have constructors. One that the compiler makes for a struct of them is not compiled
// for the vectors' instruction set, so such a struct has its own, or is made as an aggregate.
using FloatLanes = hn::Vec<Floats>;
using IntLanes = hn::Vec<Ints>;

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
