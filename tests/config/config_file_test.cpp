// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/config/config_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <type_traits>

#include "support/seeds.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::vector<std::string> complaints(const std::string& yaml) {
  const auto config = parse_config(yaml, "f.yaml");
  std::vector<std::string> texts;
  if (config) return texts;
  for (const Error& fault : config.error()) {
    EXPECT_EQ(fault.code, ErrorCode::kInvalidConfig);
    texts.push_back(fault.text());
  }
  return texts;
}

/// Another value that the field may have: a number within its limits, another name where there is
/// one.
void vary(test::Random& random, const ConfigField& field, double& value) {
  value = random.real(field.min, field.max);
}
void vary(test::Random& random, const ConfigField& field, int& value) {
  value = random.integer(static_cast<int>(field.min), static_cast<int>(field.max));
}
void vary(test::Random& random, const ConfigField& field, Eigen::Vector3d& value) {
  for (double& v : value) v = random.real(field.min, field.max);
}
void vary(test::Random& random, const ConfigField&, NewWorldRule& value) {
  value = static_cast<NewWorldRule>(random.integer(0, 2));
}
void vary(test::Random&, const ConfigField& field, std::string& value) {
  if (field.key == "integrate.ray_method") value = "line_drawing";
}
void vary(test::Random&, const ConfigField&, std::vector<std::string>& value) { value.pop_back(); }

TEST(ConfigFile, a_config_written_as_yaml_reads_back_to_the_same_bits) {
  test::for_each_seed(200, [](test::Random& random) {
    MapperConfig config;
    visit_config(config,
                 [&](const ConfigField& field, auto& value) { vary(random, field, value); });
    config.map.voxel_m = random.real(0.1, 1.0);  // so that the window has room
    config.map.size_m = Eigen::Vector3d::Constant(random.real(1.0, 20.0));
    config.map.trigger_m = 0.5 * random.real(0.02, 1.0) * config.map.size_m;
    config.depth.max_range_m = config.depth.min_range_m / 2.0 + 49.9;
    config.depth.min_range_m /= 2.0;
    const std::string yaml = config_to_yaml(config);
    const auto back = parse_config(yaml, "echo");
    ASSERT_TRUE(back) << back.error().front().text() << "\n" << yaml;
    EXPECT_EQ(config_to_yaml(back->mapper), yaml);
    EXPECT_EQ(back->mapper.map.size_m, config.map.size_m);
    EXPECT_EQ(back->mapper.sensor.subpixel_px, config.sensor.subpixel_px);
    EXPECT_EQ(back->mapper.depth.steps, config.depth.steps);
    EXPECT_EQ(back->mapper.occupancy.free_below, config.occupancy.free_below);
  });
}

TEST(ConfigFile, a_rule_for_new_worlds_is_one_of_three_names) {
  EXPECT_EQ(parse_config("map: {on_new_world: clear}", "f.yaml")->mapper.on_new_world,
            NewWorldRule::kClear);
  const auto unknown = parse_config("map: {on_new_world: forget}", "f.yaml");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().text(),
            "f.yaml:1: map.on_new_world: unknown rule 'forget'; known are: refuse, clear, keep");
  EXPECT_FALSE(parse_config("map: {on_new_world: [keep]}", "f.yaml"));
}

TEST(ConfigFile, what_a_file_does_not_say_keeps_its_default) {
  for (const char* yaml : {"", "# nothing\n", "---\n", "map:\n", "map: {}\n"}) {
    const auto config = parse_config(yaml, "f.yaml");
    ASSERT_TRUE(config) << yaml;
    EXPECT_EQ(config_to_yaml(config->mapper), config_to_yaml(MapperConfig{})) << yaml;
    EXPECT_TRUE(config->places.empty());
  }
}

TEST(ConfigFile, one_number_stands_for_all_three_axes) {
  const auto config = parse_config("map: {size_m: 8, trigger_m: [1, 2, 3]}", "f.yaml");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->mapper.map.size_m, Eigen::Vector3d(8, 8, 8));
  EXPECT_EQ(config->mapper.map.trigger_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(config->places.at("map.trigger_m"), "f.yaml:1");
}

TEST(ConfigFile, an_unknown_key_is_an_error_with_its_line_and_the_key_that_was_meant) {
  EXPECT_THAT(complaints("map:\n  voxel_cm: 20\n"),
              ElementsAre("f.yaml:2: there is no parameter 'map.voxel_cm'; did you mean "
                          "map.voxel_m"));
  EXPECT_THAT(complaints("map:\n  size_m: 10\n  voxel: 0.2\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:3:"), HasSubstr("did you mean map.voxel_m"))));
  EXPECT_THAT(complaints("\n\nvoxel_m: 0.2\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:3:"), HasSubstr("did you mean map.voxel_m"))));
  EXPECT_THAT(complaints("colour: green\n"),
              ElementsAre(HasSubstr("'swiftlet list parameters' tells which there are")));
}

TEST(ConfigFile, a_value_with_a_unit_is_an_error_that_tells_the_number_to_write) {
  EXPECT_THAT(complaints("map:\n  voxel_m: 20cm\n"),
              ElementsAre("f.yaml:2: map.voxel_m: '20cm' is not a number; the key says metres: "
                          "write 0.2"));
  EXPECT_THAT(complaints("map: {voxel_m: 50 mm}"), ElementsAre(HasSubstr("write 0.05")));
  EXPECT_THAT(complaints("map: {voxel_m: 3 cubits}"),
              ElementsAre(HasSubstr("write a plain number of metres")));
}

TEST(ConfigFile, a_value_of_the_wrong_type_is_an_error_with_its_line) {
  for (const char* yaml :
       {"depth:\n  downsample: 2.5\n", "depth:\n  downsample: [8]\n", "depth:\n  downsample: ~\n",
        "map:\n  size_m: [1, 2]\n", "map:\n  size_m: [1, 2, x]\n", "depth:\n  steps: range_gate\n",
        "map:\n  voxel_m: true\n", "map:\n  voxel_m:\n",
        "integrate:\n  ray_method: [line_drawing]\n"}) {
    EXPECT_THAT(complaints(yaml), ElementsAre(StartsWith("f.yaml:2: "))) << yaml;
  }
}

TEST(ConfigFile, a_value_outside_its_limits_is_an_error_with_key_and_line) {
  for (const char* value : {"-0.2", "0", ".nan", ".inf", "1e300", "nan", "inf"}) {
    EXPECT_THAT(complaints(std::string("map:\n\n  voxel_m: ") + value + "\n"),
                ElementsAre(StartsWith("f.yaml:3: map.voxel_m: ")))
        << value;
  }
}

TEST(ConfigFile, an_unknown_method_is_an_error_that_names_the_known_ones) {
  EXPECT_THAT(complaints("integrate:\n  logodds_per_step: 0.1\n  ray_method: magic\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:3: integrate.ray_method: "),
                                HasSubstr("voxel_traversal, line_drawing"))));
  EXPECT_THAT(complaints("depth:\n  steps: [magic]\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:2: depth.steps: "), HasSubstr("range_gate"))));
}

TEST(ConfigFile, a_window_that_cannot_be_is_an_error_with_its_line) {
  EXPECT_THAT(complaints("map:\n  voxel_m: 0.5\n  size_m: 0.1\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:3: map.size_m: "), HasSubstr("one voxel"))));
  EXPECT_THAT(complaints("map:\n  voxel_m: 0.01\n  size_m: 1500\n"),  // about 3 PB
              ElementsAre(AllOf(StartsWith("f.yaml:3: map.size_m: "), HasSubstr("GiB"))));
}

TEST(ConfigFile, a_vehicle_that_would_leave_its_window_is_an_error_with_its_line) {
  EXPECT_THAT(complaints("map:\n  size_m: [20, 20, 4]\n  trigger_m: [1, 1, 3]\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:3: map.trigger_m: "), HasSubstr("half"))));
  EXPECT_TRUE(complaints("map: {size_m: [20, 20, 4], trigger_m: [10, 10, 2]}").empty());
}

TEST(ConfigFile, all_faults_are_told_at_once) {
  EXPECT_THAT(complaints("map:\n  voxel_m: x\n  size: 3\ndepth:\n  downsample: y\n"), SizeIs(3));
}

TEST(ConfigFile, a_key_that_stands_twice_is_an_error_that_names_both_lines) {
  EXPECT_THAT(complaints("map:\n  voxel_m: 0.1\n  voxel_m: 0.2\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:3:"), HasSubstr("f.yaml:2"))));
}

TEST(ConfigFile, what_is_not_yaml_is_an_error_with_its_line) {
  EXPECT_THAT(complaints("map:\n  voxel_m: [0.1\n"), ElementsAre(StartsWith("f.yaml:")));
  EXPECT_THAT(complaints("map:\n\tvoxel_m: 0.1\n"), ElementsAre(StartsWith("f.yaml:2: ")));
  EXPECT_THAT(complaints("- a\n- b\n"), ElementsAre(HasSubstr("'key: value'")));
  EXPECT_THAT(complaints("hello"), ElementsAre(HasSubstr("'key: value'")));
}

TEST(ConfigFile, no_text_makes_the_reader_crash) {
  const std::string good = config_to_yaml(MapperConfig{});
  test::for_each_seed(300, [&](test::Random& random) {
    std::string text = good;
    for (int i = 0; i < 4; ++i) {
      text[random.integer<std::size_t>(0, text.size() - 1)] =
          static_cast<char>(random.integer<int>(0, 255));
    }
    const auto config = parse_config(text, "f.yaml");
    if (!config) {
      EXPECT_FALSE(config.error().empty());
    }
  });
}

TEST(ConfigFile, settings_win_over_the_file_and_later_ones_over_earlier_ones) {
  const test::TempFolder folder;
  test::write_file(folder / "f.yaml", "map: {voxel_m: 0.1}\ndepth: {downsample: 2}\n");
  const auto config =
      load_config({{(folder / "f.yaml").string()}, {"map.voxel_m=0.3", "map.voxel_m=0.4"}});
  ASSERT_TRUE(config);
  EXPECT_EQ(config->mapper.map.voxel_m, 0.4);
  EXPECT_EQ(config->mapper.depth.downsample, 2);
}

TEST(ConfigFile, of_several_files_a_later_one_wins_and_faults_name_their_file) {
  const test::TempFolder folder;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  test::write_file(folder / "base.yaml", "map: {voxel_m: 0.1, size_m: 8}\n");
  test::write_file(folder / "fine.yaml", "map: {voxel_m: 0.05}\n");
  const auto merged = load_config({{path("base.yaml"), path("fine.yaml")}, {}});
  ASSERT_TRUE(merged) << merged.error().front().text();
  EXPECT_EQ(merged->mapper.map.voxel_m, 0.05);
  EXPECT_EQ(merged->mapper.map.size_m, Eigen::Vector3d(8, 8, 8));
  EXPECT_EQ(merged->places.at("map.voxel_m"), path("fine.yaml") + ":1");
  EXPECT_EQ(load_config({{path("fine.yaml"), path("base.yaml")}, {}})->mapper.map.voxel_m, 0.1);

  test::write_file(folder / "bad.yaml", "\nmap: {voxel_m: -1}\n");
  const auto bad = load_config({{path("base.yaml"), path("bad.yaml")}, {}});
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().front().where, StartsWith(path("bad.yaml") + ":2"));
  test::write_file(folder / "twice.yaml", "map: {voxel_m: 0.1, voxel_m: 0.2}\n");
  EXPECT_FALSE(load_config({{path("base.yaml"), path("twice.yaml")}, {}}))
      << "a key that stands twice in one file is a fault still";
}

TEST(ConfigFile, a_hostile_text_is_an_error_with_its_line_and_no_crash) {
  EXPECT_THAT(complaints("map: &a {x: *a}\n"),
              ElementsAre(AllOf(StartsWith("f.yaml:1: "), HasSubstr("within what it repeats"))));
  std::string laughs = "k0: &k0 {a: 1, b: 2, c: 3}\n";
  for (int i = 1; i < 12; ++i) {
    laughs += fmt::format("k{0}: &k{0} [*k{1}, *k{1}, *k{1}, *k{1}, *k{1}, *k{1}, *k{1}, *k{1}]\n",
                          i, i - 1);
  }
  EXPECT_THAT(complaints(laughs), ElementsAre(HasSubstr("stands for more than")));
  EXPECT_THAT(complaints(std::string(10'000, '[')), ElementsAre(HasSubstr("deep")));
}

TEST(ConfigFile, a_setting_that_cannot_be_is_an_error) {
  for (const char* text :
       {"map.voxel_m", "map.voxel_m=", "=3", "map.voxel_m=[", "map.voxel_m=-1"}) {
    const auto config = load_config({{}, {text}});
    ASSERT_FALSE(config) << text;
    EXPECT_THAT(config.error().front().where, StartsWith("--set")) << text;
  }
}

TEST(ConfigFile, a_file_that_is_not_there_is_told) {
  const auto config = load_config({{"/no/such.yaml"}, {}});
  ASSERT_FALSE(config);
  EXPECT_EQ(config.error().front().code, ErrorCode::kNotFound);
}

TEST(ConfigFile, saved_with_a_byte_order_mark_is_read) {
  const test::TempFolder folder;
  test::write_file(folder / "c.yaml", "\xEF\xBB\xBFmap:\n  voxel_m: 0.25\n");
  const auto config = load_config({{(folder / "c.yaml").string()}, {}});
  ASSERT_TRUE(config) << config.error().front().text();
  EXPECT_EQ(config->mapper.map.voxel_m, 0.25);
}

TEST(ConfigFile, that_is_a_pipe_or_a_device_is_refused_at_once) {
  const test::TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto pipe = load_config({{(folder / "pipe").string()}, {}});
  ASSERT_FALSE(pipe);
  EXPECT_THAT(pipe.error().front().text(), HasSubstr("it is a pipe, not a file"));
  EXPECT_FALSE(load_config({{"/dev/zero"}, {}}));
}

}  // namespace
}  // namespace swiftlet
