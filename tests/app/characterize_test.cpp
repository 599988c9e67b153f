// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;

#if SWIFTLET_HAS_EMBREE
TEST(Characterize, recovers_the_disparity_error_of_the_simulated_camera_and_writes_it_down) {
  const TempFolder folder;
  const double s_px =
      run_for_json({"characterize", "noise", "sim:wall?frames=8", "-o", "d435", "--json"},
                   folder.path())
          .at("subpixel_px");
  EXPECT_NEAR(s_px, 0.08, 0.05 * 0.08);
  EXPECT_THAT(content_of(folder / "d435" / "sensor.yaml"), HasSubstr("subpixel_px: 0.08"));
  EXPECT_THAT(content_of(folder / "d435" / "noise.csv"), HasSubstr("test,"));
  const Ended mapped =
      run({"map", "sim:wall?frames=12", "--config", "d435/sensor.yaml"}, folder.path());
  EXPECT_EQ(mapped.exit_code, 0) << mapped.err;
}
#endif

TEST(Characterize, says_what_it_needs_where_there_is_no_wall) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "rec");
  write_seven_scenes(folder / "rec");  // 24 x 16 pixels: 8 x 5 in the middle
  const Ended ended = run({"characterize", "noise", "7scenes:rec"}, folder.path());
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("face a flat wall"));
}

}  // namespace
}  // namespace swiftlet::test
