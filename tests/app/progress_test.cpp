// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/progress.hpp"

#include <gtest/gtest.h>

namespace swiftlet::app {
namespace {

TEST(Progress, tells_rate_and_remaining_time) {
  EXPECT_EQ(progress_text({30, 90, 1.0}), "30/90 frames, 30.0 fps, 2 s left");
  EXPECT_EQ(progress_text({10, 1000, 10.0}), "10/1000 frames, 1.0 fps, 16:30 min left");
}

TEST(Progress, tells_no_remaining_time_where_it_is_not_known) {
  EXPECT_EQ(progress_text({30, std::nullopt, 1.0}), "30 frames, 30.0 fps");
  EXPECT_EQ(progress_text({0, 90, 0.0}), "0/90 frames, 0.0 fps");
  EXPECT_EQ(progress_text({90, 90, 3.0}), "90/90 frames, 30.0 fps");
}

TEST(Progress, the_bar_has_its_width_and_is_full_only_at_the_end) {
  EXPECT_EQ(progress_bar({0, 10, 0.0}, 4), "[>   ]   0 % ");
  EXPECT_EQ(progress_bar({5, 10, 0.0}, 4), "[==> ]  50 % ");
  EXPECT_EQ(progress_bar({999, 1000, 0.0}, 4), "[===>]  99 % ");
  EXPECT_EQ(progress_bar({10, 10, 0.0}, 4), "[====] 100 % ");
  EXPECT_EQ(progress_bar({12, 10, 0.0}, 4), "[====] 100 % ") << "more frames than were promised";
  EXPECT_EQ(progress_bar({5, std::nullopt, 0.0}, 4), "");
  EXPECT_EQ(progress_bar({5, 0, 0.0}, 4), "");
}

}  // namespace
}  // namespace swiftlet::app
