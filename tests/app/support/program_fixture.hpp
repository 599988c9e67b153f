// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet::test {

/// The built program in a folder with a recording `rec` of three good frames.
class ProgramFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "rec");
    write_seven_scenes(folder_ / "rec");
  }

  Ended swiftlet(const std::vector<std::string>& arguments) const {
    return run(arguments, folder_.path());
  }
  /// Maps the recording.
  Ended map_to(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", "7scenes:rec", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return swiftlet(arguments);
  }
  /// Every file of the working folder whose name begins so: a map and whatever stands beside it.
  std::vector<std::string> left_behind(const std::string& begin) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename();
      if (name.starts_with(begin)) names.push_back(name);
    }
    return names;
  }

  TempFolder folder_;
};

/// The program answers with this exit code, one clear line, and nothing on standard output.
inline void expect_refusal(const Ended& ended, int exit_code, const std::string& what) {
  EXPECT_EQ(ended.exit_code, exit_code) << ended.err;
  EXPECT_THAT(ended.err, ::testing::HasSubstr("swiftlet: "));
  EXPECT_THAT(ended.err, ::testing::HasSubstr(what));
  EXPECT_THAT(ended.out, ::testing::IsEmpty());
}

}  // namespace swiftlet::test
