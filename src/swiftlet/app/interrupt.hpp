// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <csignal>

namespace swiftlet::app {

/// While it lives, Ctrl-C, SIGTERM and SIGHUP (the terminal or the ssh is gone) ask for a clean
/// stop instead of ending the program; a second Ctrl-C or SIGTERM ends it, a second SIGHUP does
/// not, since a shell and the system each send one. Whoever has had a signal ignored (nohup) is
/// obeyed. Output that nobody reads any more (SIGPIPE) and files that grow beyond their limit
/// (SIGXFSZ) are errors of writing instead of the end of the flight, and stay so. At most one at a
/// time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] bool is_interrupted() const;

  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};

 private:
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace swiftlet::app
