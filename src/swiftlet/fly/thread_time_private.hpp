// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <ctime>

namespace swiftlet {

/// Processor time of the calling thread since it was made [ms]: what work takes on a core of its
/// own, whatever else the machine does.
class ThreadTime {
 public:
  [[nodiscard]] double ms() const { return now_ms() - begin_ms_; }

 private:
  static double now_ms() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
  }
  double begin_ms_ = now_ms();
};

}  // namespace swiftlet
