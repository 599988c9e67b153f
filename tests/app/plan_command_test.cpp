// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// `swiftlet plan`, on a map of two rooms: x from 0 to 4.8 m, y to 2.4 m, z to 1.6 m, and between
// them, at x = 2.4 m, a wall with a door at y from 1.6 m on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/support/run_program.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/save_map.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

void write_two_rooms(const std::filesystem::path& path) {
  BlockMap map({.voxel_m = 0.1});
  for (int i = 0; i < 6 * 3 * 2; ++i) {
    const BlockIndex index{i % 6, i / 6 % 3, i / 18};
    VoxelBlock block;
    block.voxels.fill(QuantizedLogOdds{10});
    if (index.x == 3 && index.y < 2) {  // the wall is the first layer of these
      for (int voxel = 0; voxel < kBlockVoxels; voxel += kBlockEdge)
        block.voxels[static_cast<std::size_t>(voxel)] = 250;
    }
    map.put(index, block);
  }
  ASSERT_TRUE(save_map(path, map, {}));
}

class PlanCommand : public ::testing::Test {
 protected:
  void SetUp() override { write_two_rooms(folder_ / "rooms.swl"); }

  [[nodiscard]] std::vector<std::string> words(const std::string& from, const std::string& to,
                                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"plan", "rooms.swl", "--from", from, "--to", to};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void expect_refusal(const std::vector<std::string>& how, int exit_code,
                      const std::string& what) const {
    const Ended ended = run(how, folder_.path());
    EXPECT_EQ(ended.exit_code, exit_code);
    EXPECT_THAT(ended.err, HasSubstr(what));
    EXPECT_THAT(ended.out, IsEmpty());
  }

  TempFolder folder_;
};

TEST_F(PlanCommand, goes_through_the_door_and_says_how_tight_it_is) {
  const auto told = run_for_json(words("1,0.6,0.8", "4,0.6,0.8", {"--json"}), folder_.path());
  EXPECT_GT(told["length_m"].get<double>(), 3.4);
  EXPECT_LT(told["length_m"].get<double>(), 5.0);
  EXPECT_GT(told["clearance_m"].get<double>(), 0.0);
  bool is_through = false;
  for (const auto& p : told["points"])
    is_through |= p[1].get<double>() > 1.6 && std::abs(p[0].get<double>() - 2.45) < 0.2;
  EXPECT_TRUE(is_through);
  EXPECT_THAT(run(words("1,0.6,0.8", "4,0.6,0.8"), folder_.path()).out,
              HasSubstr("tightest after"));
}

TEST_F(PlanCommand, draws_the_path) {
  const auto with = words("1,0.6,0.8", "4,0.6,0.8", {"-o", "path.png"});
  EXPECT_EQ(run(with, folder_.path()).exit_code, 0);
  EXPECT_EQ(run({"render", "rooms.swl", "-o", "plain.png", "--projection", "slice", "--z", "0.8"},
                folder_.path())
                .exit_code,
            0);
  EXPECT_NE(content_of(folder_ / "path.png"), content_of(folder_ / "plain.png"));
}

TEST_F(PlanCommand, says_why_there_is_no_path) {
  expect_refusal(words("1,0.6,0.8", "2.45,0.6,0.8"), 2, "is inside an obstacle");
  expect_refusal(words("1,0.6,0.8", "14,0.6,0.8"), 2, "lies outside the window of the map");
  expect_refusal(words("2.45,0.6,0.8", "4,0.6,0.8"), 2, "from: ");
  expect_refusal(words("1,0.6,0.8", "4,0.6,0.8", {"--radius", "1"}), 2, "would touch");
  expect_refusal(words("1,nan,0.8", "4,0.6,0.8"), 2, "not a finite number");
  expect_refusal(words("1,0.6", "4,0.6,0.8"), 2, "'1,0.6' is no place");
  expect_refusal(words("1,0.6,0.8", "4,0.6,0.8", {"--projection", "iso"}), 2, "--projection");
  expect_refusal(words("1,0.6,0.8", "4,0.6,0.8", {"-o", "rooms.swl"}), 2, "rooms.swl");
  expect_refusal(words("1,0.6,0.8", "4,0.6,0.8", {"--iterations", "0"}), 2, "--iterations");
}

}  // namespace
}  // namespace swiftlet::test
