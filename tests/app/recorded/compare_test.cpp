// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/run_program.hpp"
#include "support/recorded.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

nlohmann::json compare(const std::string& a, const std::string& b, const TempFolder& folder) {
  const Ended ended = run({"compare", a, b, "--json"}, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return nlohmann::json::parse(ended.out);
}

// An OctoMap file of a real building, written by OctoMap itself.
TEST(Compare, finds_an_octomap_equal_to_itself_and_unlike_one_of_other_voxels) {
  const auto octomaps = recorded_folder("octomap");
  SWIFTLET_NEEDS_RECORDING(octomaps);
  const TempFolder folder;
  const std::string building = std::filesystem::absolute(octomaps / "geb079.bt").string();
  const auto same = compare(building, building, folder);
  EXPECT_EQ(same.at("voxels"), 1136432);
  EXPECT_EQ(same.at("same"), same.at("voxels"));

  const std::string sample =
      std::filesystem::absolute(octomaps / "octomap_tutor_sample.bt").string();
  const Ended other = run({"compare", building, sample}, folder.path());
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, testing::HasSubstr("0.08 m"));
}

TEST(Compare, finds_a_map_and_its_export_equal_and_counts_what_differs) {
  const auto recording = recorded_folder("open3d_redwood5");
  SWIFTLET_NEEDS_RECORDING(recording);
  const TempFolder folder;
  const std::string source = "7scenes:" + std::filesystem::absolute(recording).string();
  ASSERT_EQ(run({"map", source, "-o", "all.swl"}, folder.path()).exit_code, 0);
  ASSERT_EQ(run({"map", source, "-o", "one.swl", "--frames", "1"}, folder.path()).exit_code, 0);
  const Ended exported = run({"export", "all.swl", "--to", "bt", "-o", "all.bt"}, folder.path());
  if (exported.exit_code != 0) {
    EXPECT_THAT(exported.err, testing::HasSubstr("not built"));
    return;
  }
  const auto same = compare("all.swl", "all.bt", folder);
  EXPECT_GT(same.at("voxels"), 100);
  EXPECT_EQ(same.at("same"), same.at("voxels"));
  const auto fewer = compare("one.swl", "all.bt", folder);
  EXPECT_LT(fewer.at("same"), fewer.at("voxels"));
}

}  // namespace
}  // namespace swiftlet::test
