// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/worker_team.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
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

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need all addresses
TEST(WorkerTeam, works_with_the_threads_that_the_system_grants) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto in_use = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  rlimit narrow = before;
  narrow.rlim_cur = in_use + (std::size_t{200} << 20U);  // stacks of 8 MB, for some but not for all
  ASSERT_EQ(setrlimit(RLIMIT_AS, &narrow), 0);
  {
    WorkerTeam team(64);
    EXPECT_GE(team.threads(), 1);
    EXPECT_LT(team.threads(), 64);
    std::atomic<int> calls{0};
    team.run([&](int) { ++calls; });
    EXPECT_EQ(calls, team.threads());
  }
  setrlimit(RLIMIT_AS, &before);
}
#endif

}  // namespace
}  // namespace swiftlet
