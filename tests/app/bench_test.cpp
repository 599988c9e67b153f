// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the benchmark tells.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Bench : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "rec");
    write_seven_scenes(folder_ / "rec");
  }
  Ended bench(std::vector<std::string> words) const {
    words.insert(words.begin(), "bench");
    return run(words, folder_.path());
  }
  TempFolder folder_;
};

const json* row_of(const json& rows, double voxel_m, const std::string& integrator, int threads) {
  for (const json& row : rows) {
    if (row.at("voxel_m") == voxel_m && row.at("integrator") == integrator &&
        row.at("threads") == threads && row.at("workload") == "7scenes:rec") {
      return &row;
    }
  }
  return nullptr;
}

TEST_F(Bench, has_a_row_for_every_contender_voxel_size_and_number_of_threads) {
  const Ended ended = bench({"7scenes:rec", "--voxel", "0.2,0.1", "--threads", "1,3", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json rows = json::parse(ended.out).at("rows");
  for (const double voxel_m : {0.2, 0.1}) {
    EXPECT_NE(row_of(rows, voxel_m, "projective", 1), nullptr);
    EXPECT_NE(row_of(rows, voxel_m, "projective", 3), nullptr);
    EXPECT_NE(row_of(rows, voxel_m, "rays", 1), nullptr);
    for (const char* name : {"octomap_plain", "octomap_discretised"}) {
      EXPECT_EQ(row_of(rows, voxel_m, name, 1) != nullptr, SWIFTLET_HAS_OCTOMAP == 1);
    }
  }
  constexpr std::size_t kThesisSetting = 2;  // n = 8: projective and rays
  EXPECT_EQ(rows.size(), 2 * (3 + 2 * SWIFTLET_HAS_OCTOMAP) + kThesisSetting);
}

TEST_F(Bench, every_row_has_all_of_the_schema_and_times_that_agree) {
  const Ended ended = bench({"7scenes:rec", "--voxel", "0.2", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json result = json::parse(ended.out);
  for (const char* key : {"cpu", "compiler", "build_type", "swiftlet_version"}) {
    EXPECT_THAT(result.at("machine").at(key).get<std::string>(), Not(IsEmpty())) << key;
  }
  EXPECT_GE(result.at("machine").at("cores"), 1);
  const std::set<std::string> schema{"workload",
                                     "voxel_m",
                                     "integrator",
                                     "threads",
                                     "frames",
                                     "min_ms",
                                     "median_ms",
                                     "p99_ms",
                                     "mpixel_s",
                                     "map_bytes",
                                     "speedup_vs_octomap_plain",
                                     "speedup_vs_octomap_discretised"};
  for (const json& row : result.at("rows")) {
    std::set<std::string> keys;
    for (const auto& item : row.items()) keys.insert(item.key());
    EXPECT_EQ(keys, schema);
    EXPECT_EQ(row.at("frames"), 3);
    EXPECT_GT(row.at("min_ms"), 0.0);
    EXPECT_LE(row.at("min_ms"), row.at("median_ms"));
    EXPECT_LE(row.at("median_ms"), row.at("p99_ms"));
    EXPECT_GT(row.at("map_bytes"), 0);
    constexpr double kMegapixels = 24 * 16 * 1e-6;  // of the recording
    const double mpixels =
        row.at("mpixel_s").get<double>() * 1e-3 * row.at("median_ms").get<double>();
    EXPECT_NEAR(mpixels, kMegapixels, 1e-9);
  }
}

TEST_F(Bench, speedups_are_the_ratios_of_the_medians_and_null_without_a_counterpart) {
  const Ended ended = bench({"7scenes:rec", "--voxel", "0.2", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json rows = json::parse(ended.out).at("rows");
  for (const std::string which : {"plain", "discretised"}) {
    const json* octomap = row_of(rows, 0.2, "octomap_" + which, 1);
    for (const json& row : rows) {
      const json& speedup = row.at("speedup_vs_octomap_" + which);
      const bool has_counterpart = octomap != nullptr && row.at("workload") == "7scenes:rec";
      ASSERT_EQ(speedup.is_number(), has_counterpart) << row;
      if (!has_counterpart) continue;
      const double ms = row.at("median_ms");
      // JSON holds 17 digits: the product is off by a few roundings.
      EXPECT_NEAR(speedup.get<double>() * ms, octomap->at("median_ms").get<double>(), 1e-9);
    }
  }
}

TEST_F(Bench, tells_people_of_machine_frames_and_the_tables_of_the_thesis) {
  const Ended ended = bench({"7scenes:rec", "--voxel", "0.2", "--tables"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* part : {"cores; ", "7scenes:rec: 3 of 3 frames", "24 x 16 pixels, range 5 m",
                           "7scenes:rec, n = 8", "Table 4.2", "5.480", "19.160", "10.490", "9.770",
                           "Table 4.3", "28.475", "36.517", "665.320", "left out"}) {
    EXPECT_THAT(ended.out, HasSubstr(part));
  }
  EXPECT_EQ(ended.out.find("octomap_plain") != std::string::npos, SWIFTLET_HAS_OCTOMAP == 1);
  EXPECT_EQ(ended.out.find("OctoMap was not built") != std::string::npos,
            SWIFTLET_HAS_OCTOMAP == 0);
  EXPECT_THAT(ended.err, HasSubstr("3/3 frames")) << "progress";
}

TEST_F(Bench, tables_have_a_time_on_this_machine_beside_every_one_of_the_thesis) {
  const Ended ended = bench({"7scenes:rec", "--voxel", "0.2", "--tables", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json tables = json::parse(ended.out).at("tables");
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].at("functions_4_2").size(), 4U);
  EXPECT_EQ(tables[0].at("mapping_4_3").size(), 3U);
  for (const json& line : tables[0].at("functions_4_2")) EXPECT_GT(line.at("rays_ms"), 0.0) << line;
  for (const json& line : tables[0].at("mapping_4_3")) {
    EXPECT_GT(line.at("rays_ms"), 0.0) << line;
    EXPECT_GT(line.at("projective_ms"), 0.0) << line;
  }
}

TEST_F(Bench, wrong_usage_is_exit_code_2_and_told_before_any_frame_is_read) {
  const std::vector<std::vector<std::string>> wrong{
      {"--frames", "0"},     {"--frames", "many"}, {"--warm-up", "-1"}, {"--voxel", "0"},
      {"--voxel", "0.2,x"},  {"--voxel", "nan"},   {"--voxel", "20"},   {"--threads", "0"},
      {"--threads", "1,-2"}, {"--range", "0"},     {"--range", "nan"},  {"--magic"},
      {"--model", "blunt"},  {"--fusion", "blunt"}};
  for (std::vector<std::string> words : wrong) {
    words.insert(words.begin(), "7scenes:rec");
    const Ended ended = bench(words);
    EXPECT_EQ(ended.exit_code, 2) << words[1] << ": " << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("swiftlet: "));
    EXPECT_THAT(ended.err, Not(HasSubstr("reading frames")));
    EXPECT_THAT(ended.out, IsEmpty());
  }
  const Ended second = bench({"7scenes:rec", "magic:rec"});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, HasSubstr("unknown source 'magic'"));
  EXPECT_THAT(second.err, Not(HasSubstr("reading frames")));
}

TEST_F(Bench, knows_the_names_of_the_version_before_and_tells_those_of_today) {
  const Ended ended = bench({"7scenes:rec", "--voxel", "0.2", "--fusion", "thesis", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("'--fusion' is called '--model' now"));
  EXPECT_THAT(ended.err, HasSubstr("'thesis' is called 'inverse_sensor_model' now"));
  EXPECT_THAT(ended.out, HasSubstr("inverse_sensor_model"));
}

TEST_F(Bench, fails_where_there_is_nothing_to_measure) {
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder_ / "rec", number, flat(0));
  const Ended ended = bench({"7scenes:rec"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("there is no frame to measure"));
  EXPECT_THAT(ended.out, IsEmpty());
}

}  // namespace
}  // namespace swiftlet::test
