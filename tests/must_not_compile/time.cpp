// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/time.hpp"

namespace swiftlet {

Stamp later(Stamp start, [[maybe_unused]] double s) {
#if defined(MAKES_A_TIME_OF_A_DOUBLE)
  return s;
#elif defined(ADDS_TWO_TIMES)
  return start + start;
#else
  return start + std::chrono::milliseconds(5);
#endif
}

}  // namespace swiftlet
