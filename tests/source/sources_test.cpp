// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sources.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "support/temp_folder.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

TEST(Sources, have_different_names_and_say_what_they_are) {
  std::set<std::string_view> names;
  for (const auto& source : sources()) {
    EXPECT_TRUE(names.insert(source.name).second) << source.name;
    EXPECT_EQ(source.name.find(':'), std::string_view::npos);
    EXPECT_FALSE(source.summary.empty());
  }
  EXPECT_THAT(names, ::testing::IsSupersetOf({"7scenes", "tum"}));
}

TEST(Sources, answer_an_address_without_a_kind_with_examples) {
  for (const char* address : {"", "flight3"}) {
    const auto source = open_source(address);
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::kUsage);
    EXPECT_THAT(source.error().remedy, HasSubstr("7scenes:"));
  }
  EXPECT_THAT(open_source("flight3").error().remedy, HasSubstr("tum:flight3"));
}

TEST(Sources, answer_an_unknown_kind_with_the_known_ones) {
  const auto source = open_source("kitti:/data");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kUsage);
  EXPECT_THAT(source.error().text(), HasSubstr("'kitti'"));
  EXPECT_THAT(source.error().text(), HasSubstr("7scenes, tum"));
}

class EveryFolderSource : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Error error_of_opening(const std::string& place) const {
    const auto source = open_source(std::string(GetParam()) + ":" + place);
    EXPECT_FALSE(source) << place;
    const Error error = source ? Error{} : source.error();
    EXPECT_THAT(error.where, HasSubstr(place)) << "names the place";
    EXPECT_THAT(error.remedy, HasSubstr("depth")) << "says what should be there";
    return error;
  }
  test::TempFolder folder_;
};

TEST_P(EveryFolderSource, refuses_a_folder_that_is_not_there) {
  const Error error = error_of_opening(folder_ / "nowhere");
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_THAT(error.what, HasSubstr("no such folder"));
}

TEST_P(EveryFolderSource, refuses_an_empty_folder) {
  const Error error = error_of_opening(folder_.path());
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_THAT(error.what, HasSubstr("empty"));
}

TEST_P(EveryFolderSource, refuses_a_file_in_place_of_a_folder) {
  test::write_file(folder_ / "file", "x");
  const Error error = error_of_opening(folder_ / "file");
  EXPECT_THAT(error.what, HasSubstr("it is a file, not a folder"));
}

TEST_P(EveryFolderSource, refuses_a_folder_of_other_things) {
  test::write_file(folder_ / "notes.txt", "x");
  EXPECT_EQ(error_of_opening(folder_.path()).code, ErrorCode::kNotFound);
}

TEST_P(EveryFolderSource, refuses_an_address_without_a_place) {
  EXPECT_EQ(error_of_opening("").code, ErrorCode::kUsage);
}

INSTANTIATE_TEST_SUITE_P(Sources, EveryFolderSource,
                         ::testing::Values("7scenes", "tum", "openloris"),
                         [](const auto& kind) { return std::string("source_") + kind.param; });

}  // namespace
}  // namespace swiftlet
