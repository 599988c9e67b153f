// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The built program on RealSense recordings.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/run_program.hpp"
#include "support/recorded.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

class RigProgram : public ::testing::Test {
 protected:
  void SetUp() override { SWIFTLET_NEEDS_RECORDING(recorded_folder("bags")); }

  static std::string bag(const std::string& name) {
    return (recorded_folder("bags") / name).string();
  }
  [[nodiscard]] json map(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "map");
    arguments.insert(arguments.end(), {"--json", "--overwrite"});
    const Ended ended = run(arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return json::parse(ended.out, nullptr, false);
  }

  TempFolder folder_;
};

TEST_F(RigProgram, maps_a_recording_and_tells_what_it_refused) {
  const json summary = map({"bag:" + bag("d435_t265_v2.53.1.bag")});
  EXPECT_EQ(summary["frames"], 10);
  EXPECT_EQ(summary["poses_refused"], 2);
  EXPECT_EQ(summary["poses_refused_by"]["low_confidence"], 2);
  EXPECT_EQ(summary["pose_jumps"], 0);
}

TEST_F(RigProgram, takes_the_flags_of_the_rig) {
  write_file(folder_ / "strict.yaml",
             "cameras: [{ mount: intel_t265_d435 }]\npose: { min_confidence: 3 }\n");
  const json strict = map({"bag:" + bag("d435_t265_v2.53.1.bag"), "--rig", "strict.yaml"});
  EXPECT_EQ(strict["poses_refused"], 4);
  const json nearest = map({"bag:" + bag("wall_v2.53.1.bag"), "--pairing", "nearest"});
  EXPECT_THAT(nearest["source"].get<std::string>(), HasSubstr("pairing=nearest"));
}

TEST_F(RigProgram, plays_at_the_speed_of_the_recording) {
  const json summary = map({"bag:" + bag("wall_v2.53.1.bag"), "--realtime"});
  std::size_t dropped = 0;
  for (const auto& [reason, count] : summary["dropped"].items())
    dropped += count.get<std::size_t>();
  EXPECT_EQ(summary["frames"].get<std::size_t>() + dropped, 8U);
  EXPECT_GE(summary["elapsed_s"].get<double>(), 7.0 / 30.0 - 0.001);
  const json& age = summary["latency_ms"]["camera_to_map"];
  EXPECT_GE(age["p99"].get<double>(), age["p50"].get<double>());
  EXPECT_GE(age["p50"].get<double>(), summary["latency_ms"]["p50"].get<double>())
      << "it holds the mapper's own time";
  EXPECT_FALSE(map({"bag:" + bag("wall_v2.53.1.bag"), "-o", "b.swl"})["latency_ms"].contains(
      "camera_to_map"))
      << "nobody waits for a frame of a recording";
}

TEST_F(RigProgram, refuses_what_cannot_be_joined_and_leaves_no_map) {
  const Ended ended = run({"map", "bag:" + bag("mismatch_v2.53.1.bag")}, folder_.path());
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("the device's own clock"), HasSubstr("global time"),
                               HasSubstr("Global Time Enabled")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(RigProgram, lists_the_topics_of_a_bag) {
  const Ended text = run({"info", bag("kapture_t265_trimmed_locoffice.bag")}, folder_.path());
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, AllOf(HasSubstr("/camera/odom/sample"), HasSubstr("nav_msgs/Odometry"),
                              HasSubstr("200.1 Hz")));
  const Ended ended = run({"info", bag("wall_v2.53.1.bag"), "--json"}, folder_.path());
  const json bag = json::parse(ended.out, nullptr, false);
  EXPECT_EQ(bag["compression"], "lz4");
  EXPECT_EQ(bag["device"]["Name"], "Simulated wall");
  EXPECT_EQ(bag["topics"].size(), 22U);
}

TEST_F(RigProgram, tells_of_a_bag_that_was_cut_off_what_it_holds_and_where_it_ends) {
  const std::string whole = content_of(bag("wall_v2.53.1.bag"));
  write_file(folder_ / "cut.bag", std::string_view(whole).substr(0, whole.size() / 2));
  const Ended info = run({"info", "cut.bag"}, folder_.path());
  EXPECT_EQ(info.exit_code, 1);
  EXPECT_THAT(info.out, HasSubstr("Depth_0/image/data"));
  EXPECT_THAT(info.err, AllOf(HasSubstr("cut.bag: byte"), HasSubstr("ends at byte")));
  const Ended mapped = run({"map", "bag:cut.bag", "-o", "cut.swl"}, folder_.path());
  EXPECT_EQ(mapped.exit_code, 1);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cut.swl")) << "what came before is saved";
}

}  // namespace
}  // namespace swiftlet::test
