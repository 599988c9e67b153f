// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/start_thread.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/no_threads.hpp"

namespace swiftlet {
namespace {

TEST(StartThread, runs_the_work) {
  int done = 0;
  auto thread = start_thread("test", [&done] { done = 1; });
  ASSERT_TRUE(thread);
  thread->join();
  EXPECT_EQ(done, 1);
}

#ifdef SWIFTLET_CAN_LACK_THREADS
TEST(StartThread, says_who_wanted_one_and_what_to_do_if_there_is_none) {
  const test::NoThreads none;
  const auto thread = start_thread("ground station", [] {});
  ASSERT_FALSE(thread);
  EXPECT_EQ(thread.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(thread.error().where, "ground station");
  EXPECT_THAT(thread.error().remedy, testing::HasSubstr("ulimit -u"));
}
#endif

}  // namespace
}  // namespace swiftlet
