// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/reaction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr VoxelBox kOneVoxel{{0, 0, 0}, {0, 0, 0}};

/// One voxel, frame by frame: m matter, . looked through, _ not seen; then what the map claims:
/// o occupied, f free, u unknown.
Reactions watch(const std::string& sights, const std::string& claims) {
  Reactions reactions(kOneVoxel);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const MoverSight sight = sights[i] == 'm'   ? MoverSight::kMatter
                             : sights[i] == '.' ? MoverSight::kLookedThrough
                                                : MoverSight::kNothing;
    const Occupancy claim = claims[i] == 'o'   ? Occupancy::kOccupied
                            : claims[i] == 'f' ? Occupancy::kFree
                                               : Occupancy::kUnknown;
    reactions.observe(MoverSights(kOneVoxel, sight), Claims(kOneVoxel, claim));
  }
  return reactions;
}

TEST(Reactions, counts_the_frames_until_matter_is_occupied_and_gone_matter_free) {
  const Reactions r = watch("..mmmm.....", "ffuooooooof");
  EXPECT_THAT(r.until_occupied(), ElementsAre(2));
  EXPECT_THAT(r.until_free(), ElementsAre(5));
  EXPECT_EQ(r.missed(), 0U);
  EXPECT_EQ(r.ghosts(), 0U);
}

TEST(Reactions, an_immediate_map_needs_one_frame_each) {
  const Reactions r = watch(".mm.", "foof");
  EXPECT_THAT(r.until_occupied(), ElementsAre(1));
  EXPECT_THAT(r.until_free(), ElementsAre(1));
}

TEST(Reactions, frames_that_do_not_show_the_voxel_do_not_count) {
  const Reactions r = watch("m__m__m.__.", "ffffffooffu");
  EXPECT_THAT(r.until_occupied(), ElementsAre(3));
  EXPECT_THAT(r.until_free(), IsEmpty()) << "unknown is not free";
}

TEST(Reactions, what_is_not_free_in_time_counts_even_if_it_never_is) {
  const Reactions late = watch("m" + std::string(12, '.'), std::string(12, 'o') + "f");
  EXPECT_EQ(late.not_freed(), 1U);
  EXPECT_EQ(late.freed(), 0U);
  EXPECT_EQ(watch("m" + std::string(12, '.'), "o" + std::string(12, 'u')).not_freed(), 1U);
  EXPECT_EQ(watch("m..", "oof").freed(), 1U);
  EXPECT_EQ(watch("m..", "ooo").not_freed(), 0U) << "too short to be judged";
}

TEST(Reactions, what_was_there_long_enough_and_not_noticed_is_missed) {
  EXPECT_EQ(watch("mmm.", "ffff").missed(), 1U);
  EXPECT_EQ(watch("mm.", "fff").missed(), 0U) << "too short to be judged";
}

TEST(Reactions, what_stays_occupied_is_a_ghost) {
  EXPECT_EQ(watch("mm...", "ooooo").ghosts(), 1U);
  EXPECT_EQ(watch("mm___", "ooooo").ghosts(), 1U) << "without a background, too";
  EXPECT_EQ(watch("mmmmm", "ooooo").ghosts(), 0U) << "it is still there";
  EXPECT_EQ(watch("mm_", "oou").ghosts(), 0U) << "it has decayed";
}

TEST(Reactions, what_comes_back_before_it_was_cleared_is_still_there) {
  const Reactions r = watch("m..m.", "oooof");
  EXPECT_THAT(r.until_occupied(), ElementsAre(1));
  EXPECT_THAT(r.until_free(), ElementsAre(1)) << "counted from the last time it left";
}

}  // namespace
}  // namespace swiftlet::eval
