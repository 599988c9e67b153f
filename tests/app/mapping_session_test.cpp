// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/mapping_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "support/temp_folder.hpp"
#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/session/flight_file.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::app {
namespace {

/// A wall 1 m ahead of a camera that stands at `x_m` and looks along x.
Frame wall_seen_from(double x_m, std::uint32_t epoch, int number) {
  Frame frame{
      Stamp{33'000'000LL * number}, DepthImage{Image<std::uint16_t>(24, 16, 1000)},
      PinholeIntrinsics::create(24, 16, 20, 20, 11.5, 7.5).value(),
      Transform<World, Camera>::trusted(forward_looking_camera().rotation(), {x_m, 0.0, 0.0})};
  frame.pose_epoch = epoch;
  return frame;
}

MapperConfig config_of_test() {
  MapperConfig config;
  config.depth.downsample = 1;
  config.quality.max_frozen = 0;  // one image, seen from everywhere
  return config;
}

std::unique_ptr<MappingSession> session_to(const std::filesystem::path& path,
                                           bool overwrite = false,
                                           const MapperConfig& config = config_of_test()) {
  SessionOptions options;
  options.path = path.string();
  options.store.overwrite = overwrite;
  auto session = MappingSession::create(config, options);
  EXPECT_TRUE(session) << session.error().text();
  return std::move(*session);
}

void fly(MappingSession& session, const std::vector<Frame>& frames) {
  for (const Frame& frame : frames) {
    const auto done = session.integrate(frame);
    EXPECT_TRUE(done) << done.error().text();
  }
}

/// Frames of a world that lies around x_m.
std::vector<Frame> world_at(double x_m, std::uint32_t epoch, int count) {
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(wall_seen_from(x_m, epoch, i));
  return frames;
}

struct Saved {
  double min_x_m = 1e9, max_x_m = -1e9;  // of all blocks
  std::uint64_t frames = 0;
  std::string flight;
};

Saved read(const std::filesystem::path& path) {
  Saved result;
  const auto file = load_map(path);
  EXPECT_TRUE(file) << file.error().text();
  if (!file) return result;
  result.frames = file->frames();
  result.flight = file->meta().at(std::string(kFlightKey));
  EXPECT_TRUE(file->for_each_block([&](const BlockIndex& i, const VoxelBlock&) -> Status {
    result.min_x_m = std::min(result.min_x_m, 8 * i.x * file->voxel_m());
    result.max_x_m = std::max(result.max_x_m, 8 * (i.x + 1) * file->voxel_m());
    return Done{};
  }));
  return result;
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

TEST(MappingSession, keeps_every_world_in_a_file_of_its_own_when_the_poses_lose_their_place) {
  const test::TempFolder folder;
  test::write_file(folder / "a.world2.swl", "the user's own");
  const auto session = session_to(folder / "a.swl", true);
  fly(*session, world_at(0.0, 0, 5));
  fly(*session, world_at(100.0, 1, 4));
  fly(*session, world_at(0.0, 0, 1));  // came late
  fly(*session, world_at(200.0, 2, 3));
  const auto saved = session->save();
  EXPECT_TRUE(saved) << saved.error().text();
  const MappingSummary& summary = session->summary();
  EXPECT_EQ(summary.restarts, 2U);
  EXPECT_EQ(summary.dropped(), (std::map<std::string, std::size_t>{{"other_world", 1}}));
  ASSERT_EQ(summary.files.size(), 3U);
  const char* names[] = {"a.swl", "a.world2-2.swl", "a.world3.swl"};
  const std::uint64_t frames[] = {5, 4, 3};
  for (int world = 0; world < 3; ++world) {
    const SavedFile& file = summary.files[static_cast<std::size_t>(world)];
    EXPECT_EQ(file.path, folder / names[world]);
    EXPECT_EQ(file.frames, frames[world]);
    EXPECT_THAT(summary_text(summary), ::testing::HasSubstr(file.path));
    EXPECT_THAT(summary_json(summary), ::testing::HasSubstr(file.path));
    const Saved map = read(file.path);
    EXPECT_EQ(map.frames, frames[world]);
    EXPECT_EQ(map.flight, kSavedWhole);
    EXPECT_GT(map.min_x_m, 100.0 * world - 10.0) << "nothing of another world";
    EXPECT_LT(map.max_x_m, 100.0 * world + 10.0) << "nothing of another world";
  }
  EXPECT_EQ(test::content_of(folder / "a.world2.swl"), "the user's own");
}

TEST(MappingSession, keeps_one_map_of_all_poses_if_that_is_asked_for) {
  const test::TempFolder folder;
  MapperConfig config = config_of_test();
  config.on_new_world = NewWorldRule::kKeep;
  const auto session = session_to(folder / "a.swl", false, config);
  fly(*session, world_at(0.0, 0, 5));
  fly(*session, world_at(100.0, 1, 4));
  ASSERT_TRUE(session->save());
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.swl"});
  const Saved kept = read(folder / "a.swl");
  EXPECT_EQ(kept.frames, 9U);
  EXPECT_LT(kept.min_x_m, 1.0);
  EXPECT_GT(kept.max_x_m, 100.0);
}

TEST(MappingSession, replaces_a_map_only_when_the_new_one_is_saved) {
  const test::TempFolder folder;
  test::write_file(folder / "a.swl.bak", "the user's own");
  const auto first = session_to(folder / "a.swl");
  fly(*first, world_at(0.0, 0, 5));
  ASSERT_TRUE(first->save());
  const std::string before = test::content_of(folder / "a.swl");

  const auto second = session_to(folder / "a.swl", true);
  fly(*second, world_at(0.0, 0, 2));
  std::size_t kept = 0;
  for (const std::string& name : names_in(folder.path())) {
    if (name.ends_with(".old.swl")) kept += test::content_of(folder / name) == before ? 1 : 0;
  }
  EXPECT_EQ(kept, 1U) << "the old map, whole, while the new one grows";
  ASSERT_TRUE(second->save());
  EXPECT_EQ(read(folder / "a.swl").frames, 2U);
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"a.swl", "a.swl.bak"}));
  EXPECT_EQ(test::content_of(folder / "a.swl.bak"), "the user's own");
}

/// While it lives, files of this program cannot grow beyond a size: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(std::uint64_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(MappingSession, maps_on_when_the_disk_is_full_and_tells_at_the_end_what_was_lost) {
  const test::TempFolder folder;
  SessionOptions options;
  options.path = (folder / "a.swl").string();
  options.store.pending_blocks = 8;
  options.store.batch_interval = std::chrono::milliseconds(1);
  auto session = MappingSession::create(config_of_test(), options);
  ASSERT_TRUE(session);
  fly(**session, world_at(0.0, 0, 1));
  constexpr int kFrames = 200;
  {
    const FullDisk full(40'000);          // with room for what SQLite shares with readers
    for (int i = 1; i <= kFrames; ++i) {  // each leaves all that was seen before behind
      const auto done = (*session)->integrate(wall_seen_from(50.0 * i, i <= 100 ? 0 : 1, i));
      ASSERT_TRUE(done) << done.error().text();
    }
    const auto saved = (*session)->save();
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().code, ErrorCode::kIo);
    EXPECT_THAT(saved.error().text(), ::testing::HasSubstr("the newest state of"));
  }
  const MappingSummary& summary = (*session)->summary();
  EXPECT_EQ(summary.integrated(), kFrames + 1U);
  EXPECT_GT(summary.blocks_lost, 0U);
  EXPECT_THAT(summary_text(summary), ::testing::HasSubstr("the disk refused them"));
  ASSERT_FALSE(summary.files.empty());
  EXPECT_TRUE(check_map(folder / "a.swl").empty()) << "what is there is good";
}

}  // namespace
}  // namespace swiftlet::app
