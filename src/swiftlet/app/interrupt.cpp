// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/interrupt.hpp"

#include <csignal>

namespace swiftlet::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void ask_to_stop(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);  // whoever asks twice means it
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::is_interrupted() const { return interrupted != 0; }

}  // namespace swiftlet::app
