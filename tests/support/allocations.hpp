// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>

namespace swiftlet::test {

/// Counts calls of operator new in this program since it was made. The counting operators stand in
/// allocations.cpp.
class AllocationCount {
 public:
  AllocationCount();
  [[nodiscard]] std::size_t so_far() const;

 private:
  std::size_t at_start_;
};

}  // namespace swiftlet::test
