// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "swiftlet/file/yaml_document_private.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string complaint(std::string_view text, const YamlLimits& limits = {}) {
  const auto root = parse_yaml(text, "f.yaml", limits);
  return root ? std::string("none") : root.error().text();
}

/// Each level repeats the one below it so many times.
std::string laughs(int levels, int times) {
  std::string text = "k0: &k0 {a: 1, b: 2}\n";
  for (int level = 1; level <= levels; ++level) {
    text += fmt::format("k{0}: &k{0} {{", level);
    for (int i = 0; i < times; ++i) text += fmt::format("x{}: *k{}, ", i, level - 1);
    text += "}\n";
  }
  return text;
}

TEST(YamlDocument, reads_what_people_write_with_aliases_too) {
  const auto root = parse_yaml("a: &wall {from: [1, 2], to: 3}\nb: *wall\n", "f.yaml");
  ASSERT_TRUE(root) << root.error().text();
  EXPECT_EQ((*root)["b"]["from"][1].Scalar(), "2");
  EXPECT_EQ(complaint(laughs(2, 3)), "none");
  for (const char* empty : {"", "\n", "# nothing\n", "---\n"}) {
    const auto nothing = parse_yaml(empty, "f.yaml");
    ASSERT_TRUE(nothing) << empty;
    EXPECT_TRUE(nothing->IsNull()) << empty;
  }
}

TEST(YamlDocument, refuses_an_alias_of_what_it_stands_in) {
  EXPECT_THAT(complaint("a: 1\nmap: &m {x: *m}\n"),
              AllOf(StartsWith("f.yaml:2: "), HasSubstr("within what it repeats")));
  EXPECT_THAT(complaint("&m [1, [*m]]"), HasSubstr("within what it repeats"));
  EXPECT_THAT(complaint("&m {? *m : 1}"), HasSubstr("within what it repeats"));
}

TEST(YamlDocument, refuses_aliases_that_stand_for_more_than_the_text_is_worth_in_no_time) {
  const auto start = std::chrono::steady_clock::now();
  for (const int levels : {6, 20, 1000})
    EXPECT_THAT(complaint(laughs(levels, 9)), HasSubstr("stands for more than")) << levels;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_THAT(complaint(laughs(100, 1)), HasSubstr("deep")) << "aliases may not add up depth";
}

TEST(YamlDocument, refuses_what_is_too_deep_or_too_large) {
  for (const std::string_view open : {"[", "{a: ", "- ", "? ", "{[ "}) {
    std::string text;
    for (int i = 0; i < 20'000; ++i) text += open;
    EXPECT_THAT(complaint(text), HasSubstr("deep")) << open;
  }
  EXPECT_THAT(complaint("[1, 2, 3]", {.bytes = 8}), HasSubstr("9 bytes"));
  EXPECT_THAT(complaint("[1, 2, 3]", {.nodes = 3}), HasSubstr("more than 3 values"));
  EXPECT_EQ(complaint("[1, 2, 3]", {.nodes = 4}), "none");
  EXPECT_EQ(complaint("[[1]]", {.depth = 2}), "none");
  EXPECT_THAT(complaint("[[[1]]]", {.depth = 2}), HasSubstr("deep"));
}

TEST(YamlDocument, refuses_a_second_document_that_nobody_would_read) {
  EXPECT_THAT(complaint("a: 1\n---\nb: 2\n"),
              AllOf(StartsWith("f.yaml:"), HasSubstr("second document")));
}

TEST(YamlDocument, tells_the_line_of_what_is_no_yaml) {
  EXPECT_THAT(complaint("a: 1\nb: [1, 2\nc: 3\n"), AllOf(StartsWith("f.yaml:"), HasSubstr("YAML")));
  EXPECT_THAT(complaint("a: *nobody\n"), StartsWith("f.yaml:1: "));
}

}  // namespace
}  // namespace swiftlet
