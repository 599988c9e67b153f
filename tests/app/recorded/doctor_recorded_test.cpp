// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The doctor on RealSense recordings.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/support/run_program.hpp"
#include "support/recorded.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;

class DoctorOnRecordings : public ::testing::Test {
 protected:
  void SetUp() override { SWIFTLET_NEEDS_RECORDING(recorded_folder("bags")); }
  [[nodiscard]] Ended examine(const std::string& bags) const {
    return run({"doctor", "bag:" + bags}, folder_.path());
  }
  static std::string bag(const std::string& name) {
    return (recorded_folder("bags") / name).string();
  }
  TempFolder folder_;
};

TEST_F(DoctorOnRecordings, is_content_with_a_good_one) {
  const Ended ended = examine(bag("wall_v2.53.1.bag"));
  EXPECT_EQ(ended.exit_code, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("global time"));
  EXPECT_THAT(ended.out, HasSubstr("looks forward"));
  EXPECT_THAT(ended.out, HasSubstr("0 faults"));
}

TEST_F(DoctorOnRecordings, finds_clocks_that_do_not_fit) {
  const Ended ended = examine(bag("mismatch_v2.53.1.bag"));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.out, HasSubstr("nobody can tell"));
}

TEST_F(DoctorOnRecordings, says_that_a_file_of_one_device_has_no_poses) {
  const Ended ended = examine(bag("d435_only_v2.53.1.bag"));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.out, HasSubstr("one file a device"));
}

}  // namespace
}  // namespace swiftlet::test
