// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The experiments that take no flight, by the built program; the others are run by hand, as
// docs/accuracy.md says, and their results stand in tests/end_to_end.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "swiftlet/app/report/experiment_report.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Experiment : public ::testing::Test {
 protected:
  Ended swiftlet(const std::vector<std::string>& arguments) const {
    return run(arguments, folder_.path());
  }
  TempFolder folder_;
};

TEST_F(Experiment, the_sensor_model_is_that_of_the_thesis_and_its_report_needs_no_network) {
  const Ended ended = swiftlet({"experiment", "sensor_model", "-o", "out", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto results = nlohmann::json::parse(ended.out).at("experiments");
  ASSERT_EQ(results.size(), 2U);
  for (const auto& result : results) {
    EXPECT_EQ(result.at("passed"), true) << result;
    EXPECT_THAT(result, ::testing::SizeIs(4U)) << "name, passed, expected, got";
  }
  const std::string page = content_of(folder_ / "out" / "report.html");
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
  for (const char* foreign : {"src=", "<link", "<script", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(foreign)));
  EXPECT_THAT(content_of(folder_ / "out" / "sensor_model.csv"), HasSubstr("reading at 8 m,"));
}

#if SWIFTLET_HAS_EMBREE
TEST_F(Experiment, the_noise_of_the_simulated_camera_is_that_of_the_theory) {
  const Ended ended = swiftlet({"experiment", "noise", "-o", "out"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("passed  disparity error s from the walls"));
}
#endif

TEST_F(Experiment, may_be_called_as_a_command_is) {
  const Ended ended = swiftlet({"experiment", "fly", "--flights", "0", "-o", "out"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--flights")) << "not that fly lacks its scene";
}

TEST_F(Experiment, an_unknown_one_is_a_wrong_usage_that_names_those_there_are) {
  const Ended ended = swiftlet({"experiment", "teleport", "-o", "out"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("unknown experiment 'teleport'; known are: large_box, "));
}

TEST_F(Experiment, a_folder_that_cannot_be_made_is_told_before_the_work) {
  write_file(folder_ / "file", "");
  const Ended ended = swiftlet({"experiment", "sensor_model", "-o", "file/out"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("the folder cannot be made"));
}

TEST(ExperimentFigure, is_drawn_as_svg_and_png_where_there_is_a_gnuplot) {
  const TempFolder folder;
  eval::Figure figure{"lines", "Title", "x", "y"};
  figure.curves = {{"a", {{0.0, 1.0}, {1.0, 2.0}}, false}};
  const auto svg = app::draw_figure(figure, folder.path());
  ASSERT_TRUE(svg);
  EXPECT_TRUE(svg->empty() || svg->starts_with("<svg"));
  // gnuplot-nox of Debian and Ubuntu draws PNG, too.
  EXPECT_TRUE(svg->empty() || content_of(folder / "lines.png").starts_with("\x89PNG"));
  EXPECT_EQ(content_of(folder / "lines.csv"), "curve,x,y\na,0,1\na,1,2\n");
  EXPECT_FALSE(app::draw_figure(figure, (folder / "nowhere").string()));
}

}  // namespace
}  // namespace swiftlet::test
