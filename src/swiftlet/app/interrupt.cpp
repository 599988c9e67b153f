// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/interrupt.hpp"

#include <csignal>

namespace swiftlet::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void ask_to_stop(int signal) {
  interrupted = 1;
  if (signal != SIGHUP) std::signal(signal, SIG_DFL);  // whoever asks twice means it
}

bool is_to_be_ignored(int signal) { return signal == SIGPIPE || signal == SIGXFSZ; }

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler == SIG_IGN) continue;
    std::signal(kSignals[i], is_to_be_ignored(kSignals[i]) ? SIG_IGN : ask_to_stop);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    // What is still to be printed of the flight may find nobody who reads it.
    if (!is_to_be_ignored(kSignals[i])) sigaction(kSignals[i], &before_[i], nullptr);
  }
}

bool InterruptGuard::is_interrupted() const { return interrupted != 0; }

}  // namespace swiftlet::app
