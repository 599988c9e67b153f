// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/worker_team.hpp"

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

WorkerTeam::WorkerTeam(int threads) {
  SWIFTLET_REQUIRE(threads >= 1, "the owner is one of the threads");
  workers_.reserve(static_cast<std::size_t>(threads - 1));
  for (int worker = 1; worker < threads; ++worker)
    workers_.emplace_back([this, worker] { serve(worker); });
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
  for (std::uint32_t left = busy_; left != 0; left = busy_) busy_.wait(left);
}

void WorkerTeam::serve(int worker) {
  std::uint32_t seen = 0;
  for (;;) {
    round_.wait(seen);
    ++seen;  // run() waits for every worker, so no round is missed
    if (is_closing_) return;
    call_(context_, worker);
    if (--busy_ == 0) busy_.notify_one();
  }
}

}  // namespace swiftlet
