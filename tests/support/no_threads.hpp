// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <fstream>
#include <system_error>
#include <thread>
#include <vector>

namespace swiftlet::test {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need all addresses
#define SWIFTLET_CAN_LACK_THREADS 1

/// While it lives, there is room for data of this process but for no further thread, whose stack
/// takes 8 MB. Stacks of threads that have ended are kept to be used again: it uses them.
class NoThreads {
 public:
  NoThreads() {
    threads_.reserve(kMostThreads);
    EXPECT_EQ(getrlimit(RLIMIT_AS, &before_), 0);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit narrow = before_;
    narrow.rlim_cur =
        pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (std::size_t{6} << 20U);
    EXPECT_EQ(setrlimit(RLIMIT_AS, &narrow), 0);
    try {
      while (threads_.size() < kMostThreads)
        threads_.emplace_back([this] { is_over_.wait(false); });
      ADD_FAILURE() << "there were threads for all";
    } catch (const std::system_error&) {
    }
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;
  ~NoThreads() {
    is_over_ = true;
    is_over_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    setrlimit(RLIMIT_AS, &before_);
  }

 private:
  static constexpr std::size_t kMostThreads = 100;
  rlimit before_{};
  std::atomic<bool> is_over_{false};
  std::vector<std::thread> threads_;
};
#endif

}  // namespace swiftlet::test
