// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/worker_team.hpp"

#include <system_error>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

/// Waits until a value is no longer this one. A frame has several rounds a fraction of a
/// millisecond apart, less than falling asleep and waking up takes: looks again for some 20 us
/// before it sleeps.
std::uint32_t wait_beyond(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  for (int looks = 0; looks < 20'000; ++looks) {
    if (const std::uint32_t now = value.load(std::memory_order_acquire); now != old) return now;
  }
  value.wait(old);
  return value;
}

}  // namespace

WorkerTeam::WorkerTeam(int threads) {
  SWIFTLET_REQUIRE(threads >= 1, "the owner is one of the threads");
  workers_.reserve(static_cast<std::size_t>(threads - 1));
  // Thrown on, the fault would find the threads before it running, and that ends the program.
  try {
    for (int worker = 1; worker < threads; ++worker)
      workers_.emplace_back([this, worker] { serve(worker); });
  } catch (const std::system_error&) {
    return;
  }
}

WorkerTeam::~WorkerTeam() {
  is_closing_ = true;
  ++round_;
  round_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerTeam::start(Call call, void* context) {
  if (workers_.empty()) return;
  call_ = call;
  context_ = context;
  busy_ = static_cast<std::uint32_t>(workers_.size());
  ++round_;
  round_.notify_all();
}

void WorkerTeam::finish() {
  for (std::uint32_t left = busy_; left != 0;) left = wait_beyond(busy_, left);
}

void WorkerTeam::serve(int worker) {
  std::uint32_t seen = 0;
  for (;;) {
    wait_beyond(round_, seen);
    ++seen;  // run() waits for every worker, so no round is missed
    if (is_closing_) return;
    call_(context_, worker);
    if (--busy_ == 0) busy_.notify_one();
  }
}

}  // namespace swiftlet
