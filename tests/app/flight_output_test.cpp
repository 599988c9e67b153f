// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// The built program and the files that are the user's own: none is lost, whatever he types and
// whatever the disk does.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;

class FlightOutput : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "rec");
    write_seven_scenes(folder_ / "rec");
  }
  Ended swiftlet(const std::vector<std::string>& arguments) const {
    return run(arguments, folder_.path());
  }
  /// Maps the folder of three good frames.
  Ended map_to(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", "7scenes:rec", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return swiftlet(arguments);
  }
  /// Wrong usage, in one clear line.
  static void expect_refusal(const Ended& ended, const std::string& what) {
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("swiftlet: "));
    EXPECT_THAT(ended.err, HasSubstr(what));
    EXPECT_EQ(ended.out, "");
  }

  TempFolder folder_;
};

TEST_F(FlightOutput, an_output_is_never_its_input_nor_a_map_whatever_it_is_called) {
  namespace fs = std::filesystem;
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const std::string before = content_of(folder_ / "a.swl");
  fs::create_symlink("a.swl", folder_ / "link.png");
  fs::create_hard_link(folder_ / "a.swl", folder_ / "twin.png");
  fs::copy_file(folder_ / "a.swl", folder_ / "other.swl");
  for (const std::string out : {"a.swl", "./a.swl", "link.png", "twin.png"}) {
    expect_refusal(swiftlet({"render", "a.swl", "-o", out}), "this is the input a.swl");
    expect_refusal(swiftlet({"export", "a.swl", "--to", "ply", "-o", out}), "the input a.swl");
    EXPECT_EQ(content_of(folder_ / out), before) << out;
  }
  expect_refusal(swiftlet({"render", "a.swl", "-o", "other.swl"}), "other.swl: this is a Swift");
  expect_refusal(swiftlet({"export", "a.swl", "--to", "pcd", "-o", "other.swl"}), "a Swiftlet map");
  expect_refusal(swiftlet({"render", "a.swl", "-o", "/dev/null"}), "is not a file");
  write_file(folder_ / "wall.bag", "#ROSBAG V2.0\n");
  expect_refusal(
      swiftlet({"calibrate", "distortion", "bag:wall.bag?pairing=nearest", "-o", "wall.bag"}),
      "this is the input wall.bag");
}

}  // namespace
}  // namespace swiftlet::test
