// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

namespace swiftlet::app {

/// While it lives, Ctrl-C and SIGTERM ask for a clean stop instead of ending the program; the
/// second one ends it. At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] bool is_interrupted() const;
};

}  // namespace swiftlet::app
