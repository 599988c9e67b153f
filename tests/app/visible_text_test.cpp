// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/visible_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "app/support/run_program.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/save_map.hpp"

namespace swiftlet::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(VisibleText, spells_out_what_would_act_on_a_terminal_and_keeps_what_people_write) {
  EXPECT_EQ(visible("käfer 鳥 \xF0\x9F\x90\xA6"), "käfer 鳥 \xF0\x9F\x90\xA6");
  EXPECT_EQ(visible("\x1b]0;gone\x07"), "\\u001b]0;gone\\u0007");
  EXPECT_EQ(visible("a\nb\tc\x7f"), "a\\u000ab\\u0009c\\u007f");
  EXPECT_EQ(visible("\xC2\x9B"
                    "31m"),
            "\\u009b31m")
      << "an escape of Latin-1";
  EXPECT_EQ(visible("\xE2\x80\xAE"
                    "txt.exe"),
            "\\u202etxt.exe")
      << "right to left";
  EXPECT_EQ(visible("\xff|\xC3|\xED\xA0\x80|\xC0\xAF|\xE2\x82"),
            "\uFFFD|\uFFFD|\uFFFD|\uFFFD\uFFFD|\uFFFD");
}

TEST(VisibleText, is_the_same_in_one_piece_or_in_many) {
  test::for_each_seed(200, [](test::Random& random) {
    std::string text;
    for (int i = 0; i < 40; ++i) {
      text += random.integer(0, 1) == 0 ? std::string(1, static_cast<char>(random.integer(0, 255)))
                                        : std::string("\xE2\x82\xAC");
    }
    VisibleLines whole, pieces;
    std::string expected = whole(text);
    expected += whole.finish();
    std::string shown;
    for (const char c : text) shown += pieces({&c, 1});
    shown += pieces.finish();
    EXPECT_EQ(shown, expected);
  });
}

TEST(VisibleText, a_map_full_of_odd_bytes_is_told_as_text_and_as_json) {
  const test::TempFolder folder;
  BlockMap map({0.1, {}, 1});
  map.set({}, kUnknownVoxel);
  ASSERT_TRUE(save_map(folder / "a.swl", map,
                       {{"source", "\x1b[31mred\xff\x9b"}, {"k\x1b[2J\nforged", "v"}}));
  const auto text = test::run({"info", "a.swl"}, folder / ".");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(text.out, Not(HasSubstr("\nforged")));
  EXPECT_THAT(text.out, HasSubstr("\\u001b[31mred\uFFFD"));
  const auto json = test::run_for_json({"info", "a.swl", "--json"}, folder / ".");
  EXPECT_EQ(json["meta"]["source"], "\x1b[31mred\uFFFD\uFFFD");

  const auto error = test::run({"info", "\x1b[31mnone\n.swl"}, folder / ".");
  EXPECT_EQ(error.exit_code, 1);
  EXPECT_THAT(error.err, Not(HasSubstr("\x1b")));
  EXPECT_THAT(error.err, HasSubstr("\\u001b[31mnone\\u000a.swl"));
}

}  // namespace
}  // namespace swiftlet::app
