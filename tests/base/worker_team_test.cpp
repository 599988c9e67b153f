// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/worker_team.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>

namespace swiftlet {
namespace {

TEST(WorkerTeam, calls_every_worker_once_in_every_round) {
  for (const int threads : {1, 2, 5}) {
    WorkerTeam team(threads);
    ASSERT_EQ(team.threads(), threads);
    std::vector<int> calls(static_cast<std::size_t>(threads), 0);
    for (int round = 1; round <= 2000; ++round) {
      team.run([&](int worker) { ++calls[static_cast<std::size_t>(worker)]; });
      ASSERT_EQ(std::accumulate(calls.begin(), calls.end(), 0), round * threads);
    }
    for (const int count : calls) EXPECT_EQ(count, 2000);
  }
}

// Long enough for workers to fall asleep between rounds, and for the owner to sleep in one.
TEST(WorkerTeam, wakes_after_sleep_and_returns_only_when_the_slowest_has) {
  WorkerTeam team(3);
  for (int round = 0; round < 5; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    std::atomic<int> done{0};
    team.run([&](int worker) {
      std::this_thread::sleep_for(std::chrono::milliseconds(worker));
      ++done;
    });
    EXPECT_EQ(done, 3);
  }
}

}  // namespace
}  // namespace swiftlet
