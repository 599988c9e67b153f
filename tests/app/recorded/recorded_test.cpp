// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "support/recorded.hpp"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "app/support/blocks_of.hpp"
#include "app/support/run_program.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

struct Recording {
  const char* name;
  const char* voxel;  ///< small enough that a table's things are more than one voxel
  const char* downsample;
  friend std::ostream& operator<<(std::ostream& out, const Recording& r) { return out << r.name; }
};
constexpr std::array kRecordings{
    Recording{"sevenscenes_room200", "map.voxel_m=0.1", "depth.downsample=8"},
    Recording{"realsense_f200_tabletop50", "map.voxel_m=0.05", "depth.downsample=4"}};

using Flight = std::tuple<Recording, const char*>;  // and the ray method
class RecordedFlight : public ::testing::TestWithParam<Flight> {};

TEST_P(RecordedFlight, loses_no_frame_and_gives_the_same_map_bits_twice) {
  const auto& [flown, rays] = GetParam();
  const auto recording = recorded_folder(flown.name);
  SWIFTLET_NEEDS_RECORDING(recording);
  const TempFolder folder;
  for (const char* file : {"a.swl", "b.swl"}) {
    const Ended ended =
        run({"map", "7scenes:" + std::filesystem::absolute(recording).string(), "-o", file,
             "--rays", rays, "--json", "--set", flown.voxel, "--set", flown.downsample},
            folder.path());
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto summary = nlohmann::json::parse(ended.out);
    EXPECT_EQ(summary.at("dropped"), nlohmann::json::object());
    EXPECT_GT(summary.at("voxels").at("occupied"), 100);
    EXPECT_GT(summary.at("voxels").at("free"), 100);
  }
  EXPECT_EQ(blocks_of(folder / "a.swl"), blocks_of(folder / "b.swl"));
}

INSTANTIATE_TEST_SUITE_P(, RecordedFlight,
                         ::testing::Combine(::testing::ValuesIn(kRecordings),
                                            ::testing::Values("voxel_traversal", "line_drawing")),
                         [](const auto& flight) {
                           return std::string(std::get<0>(flight.param).name) + "_" +
                                  std::get<1>(flight.param);
                         });

}  // namespace
}  // namespace swiftlet::test
