// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/config/config_aliases.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "swiftlet/config/config_file.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(ConfigAliases, an_old_key_and_its_old_value_are_read_as_the_new_ones_and_told) {
  const auto config = parse_config("integrate:\n  fusion: thesis\n", "f.yaml");
  ASSERT_TRUE(config) << config.error().front().text();
  EXPECT_EQ(config->mapper.integrate.model, "inverse_sensor_model");
  ASSERT_THAT(config->warnings, SizeIs(2));
  EXPECT_THAT(config->warnings[0].text(),
              AllOf(HasSubstr("f.yaml:2"), HasSubstr("'integrate.fusion'"),
                    HasSubstr("'integrate.model'")));
  EXPECT_THAT(config->warnings[1].text(),
              AllOf(HasSubstr("'thesis'"), HasSubstr("'inverse_sensor_model'")));
}

TEST(ConfigAliases, names_of_today_are_not_told_of) {
  const auto config = parse_config("integrate:\n  model: precision_weighted\n", "f.yaml");
  ASSERT_TRUE(config);
  EXPECT_THAT(config->warnings, IsEmpty());
}

TEST(ConfigAliases, every_old_value_stands_for_one_that_can_be_used) {
  for (const RenamedValue& value : renamed_values()) {
    const auto config = load_config({{}, {fmt::format("{}={}", value.key, value.before)}});
    ASSERT_TRUE(config) << value.before;
    const auto same = load_config({{}, {fmt::format("{}={}", value.key, value.now)}});
    ASSERT_TRUE(same) << value.now;
    EXPECT_EQ(config_to_yaml(config->mapper), config_to_yaml(same->mapper));
    EXPECT_THAT(config->warnings, SizeIs(1));
    EXPECT_EQ(config->warnings.front().where, "--set");
  }
}

TEST(ConfigAliases, old_keys_are_none_of_today_and_stand_for_one_of_today) {
  const MapperConfig defaults;
  for (const RenamedKey& renamed : renamed_keys()) {
    int now = 0;
    visit_config(defaults, [&](const ConfigField& field, const auto&) {
      EXPECT_NE(field.key, renamed.before);
      now += field.key == renamed.now ? 1 : 0;
    });
    EXPECT_EQ(now, 1) << renamed.now;
  }
}

TEST(ConfigAliases, the_old_and_the_new_key_in_one_file_are_the_same_key_twice) {
  const auto config =
      parse_config("integrate:\n  fusion: thesis\n  model: precision_weighted\n", "f.yaml");
  ASSERT_FALSE(config);
  EXPECT_THAT(config.error().front().text(), HasSubstr("f.yaml:3"));
}

TEST(ConfigAliases, stand_in_the_glossary) {
  std::ifstream file(SWIFTLET_SOURCE_DIR "/docs/glossary.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const RenamedKey& key : renamed_keys())
    EXPECT_THAT(text.str(), HasSubstr(fmt::format("| `{}` | `{}` |", key.before, key.now)));
  for (const RenamedValue& value : renamed_values()) {
    EXPECT_THAT(text.str(), HasSubstr(fmt::format("| `{}: {}` | `{}: {}` |", value.key,
                                                  value.before, value.key, value.now)));
  }
}

}  // namespace
}  // namespace swiftlet
