// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace swiftlet::test {

/// Runs a law once with the kernels of each instruction set of this machine, and tells it the name.
/// Returns how many there are.
template <class Law>
int on_every_instruction_set(Law law) {
#if defined(HWY_COMPILE_ONLY_STATIC)  // there is one alone
  law("the one there is");
  return 1;
#else
  const std::int64_t all = hwy::SupportedTargets();
  int count = 0;
  for (std::int64_t rest = all; rest != 0; rest &= rest - 1, ++count) {
    const std::int64_t target = rest & -rest;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    law(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(all);
  return count;
#endif
}

}  // namespace swiftlet::test
