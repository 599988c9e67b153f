// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using namespace std::chrono_literals;
using test::Random;
using test::TempFolder;

/// The world of the flight below: in frame f the vehicle is at x = f blocks along a path that turns
/// back, and writes f into the blocks around it. So each state of each block names its frame.
struct Flight {
  static double x_m(std::uint64_t frame) {
    const auto step = static_cast<double>(frame % 200);
    return 0.4 * (step < 100 ? step : 200 - step);
  }
  static VoxelBlock state(const BlockIndex& index, std::uint64_t frame) {
    VoxelBlock block;
    for (std::size_t i = 0; i < block.voxels.size(); ++i) {
      const auto bits = mix_bits(frame * 512 + i) ^ BlockHash {}(index);
      block.voxels[i] = static_cast<QuantizedLogOdds>(bits);
    }
    // The frame itself, in the first voxels.
    for (std::size_t i = 0; i < 4; ++i)
      block.voxels[i] = static_cast<QuantizedLogOdds>(frame >> (8 * i));
    return block;
  }
  static std::uint64_t frame_of(const VoxelBlock& block) {
    std::uint64_t frame = 0;
    for (std::size_t i = 0; i < 4; ++i) frame |= std::uint64_t{block.voxels[i]} << (8 * i);
    return frame;
  }
  /// The blocks that frame f changes.
  template <class Visit>
  static void for_each_changed(std::uint64_t frame, Visit&& visit) {
    const BlockIndex middle = block_of(voxel_containing({x_m(frame), 0, 0}, 0.1));
    for_each_block({{middle.x - 1, middle.y - 1, middle.z}, {2, 2, 1}}, visit);
  }
};

/// Flies until it is killed; tells `pipe` after each batch the frame that it holds.
[[noreturn]] void fly(const std::filesystem::path& path, int pipe) {
  auto store = BlockStore::create(path, 0.1, {.batch_interval = 5ms});
  if (!store) _exit(3);
  RollingMap map = test::small_map();
  (*store)->follow(map.reader());
  std::uint64_t batches = 0;
  for (std::uint64_t frame = 1;; ++frame) {
    map.recentre({Flight::x_m(frame), 0, 0}, store->get());
    Flight::for_each_changed(
        frame, [&](const BlockIndex& index) { map.writable(index) = Flight::state(index, frame); });
    map.publish({frame});
    const BlockStoreStats stats = (*store)->stats();
    if (stats.batches == batches) continue;
    batches = stats.batches;
    if (write(pipe, &stats.frames_committed, sizeof stats.frames_committed) < 0) _exit(4);
  }
}

/// Kills a flight after `delay`; the last frame that it reported as committed.
std::uint64_t kill_flight(const std::filesystem::path& path, std::chrono::microseconds delay) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    fly(path, ends[1]);
  }
  close(ends[1]);
  std::uint64_t committed = 0;
  // The first report is the start; a pipe that is read too late would hold the flight up.
  EXPECT_EQ(read(ends[0], &committed, sizeof committed), ssize_t{sizeof committed});
  const auto end = std::chrono::steady_clock::now() + delay;
  std::thread killer([&] {
    std::this_thread::sleep_until(end);
    kill(child, SIGKILL);
  });
  std::uint64_t reported = 0;
  while (read(ends[0], &reported, sizeof reported) == ssize_t{sizeof reported})
    committed = reported;
  killer.join();
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "the flight ended by itself";
  return committed;
}

TEST(KilledWriter, leaves_a_consistent_file_with_everything_up_to_the_last_batch) {
  Random random;
  for (int round = 0; round < 10; ++round) {
    TempFolder folder;
    const auto delay = std::chrono::microseconds(random.integer(0, 150'000));
    const std::uint64_t committed = kill_flight(folder / "a.swl", delay);
    EXPECT_TRUE(check_map(folder / "a.swl").empty()) << random.repeat();
    EXPECT_GE(load_map(folder / "a.swl")->frames(), committed);

    test::Blocks expected;  // the least that must be there: the state at the committed frame
    for (std::uint64_t frame = 1; frame <= committed; ++frame) {
      Flight::for_each_changed(
          frame, [&](const BlockIndex& index) { expected[index] = Flight::state(index, frame); });
    }
    const test::Blocks found = test::blocks_in(folder / "a.swl");
    for (const auto& [index, block] : found) {
      const std::uint64_t frame = Flight::frame_of(block);
      ASSERT_EQ(block, Flight::state(index, frame)) << "a torn block; " << random.repeat();
    }
    for (const auto& [index, block] : expected) {
      ASSERT_TRUE(found.contains(index)) << "committed " << committed << "; " << random.repeat();
      ASSERT_GE(Flight::frame_of(found.at(index)), Flight::frame_of(block)) << random.repeat();
    }
  }
}

/// In a child, so that the limit on the size of files stays there. Exit code 0 = all as promised.
int map_onto_a_full_disk(const std::filesystem::path& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  Random random(5);
  auto store = BlockStore::create(path, 0.1, {.batch_interval = 2ms, .pending_blocks = 256});
  if (!store) return 1;
  const rlimit limit{256 * 1024, 256 * 1024};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
  for (int i = 0; i < 20'000; ++i) {  // 10 MB that do not compress: mapping must go on
    (*store)->evict({i, 0, 0}, test::random_block(random), static_cast<std::uint64_t>(i));
  }
  const BlockStoreStats stats = (*store)->stats();
  if (!stats.error || stats.error->code != ErrorCode::kIo) return 3;
  if (stats.lost == 0 || stats.batches == 0) return 4;
  if (stats.error->text().find(path.string()) == std::string::npos) return 5;
  return (*store)->close() ? 6 : 0;
}

TEST(FullDisk, is_reported_and_leaves_what_was_written_intact) {
  TempFolder folder;
  const pid_t child = fork();
  if (child == 0) _exit(map_onto_a_full_disk(folder / "a.swl"));
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(check_map(folder / "a.swl").empty());
  Random random(5);
  const test::Blocks found = test::blocks_in(folder / "a.swl");
  for (int i = 0; i < 20'000; ++i) {
    const VoxelBlock block = test::random_block(random);
    const auto stored = found.find({i, 0, 0});
    ASSERT_TRUE(stored == found.end() || stored->second == block) << i;
  }
}

}  // namespace
}  // namespace swiftlet
