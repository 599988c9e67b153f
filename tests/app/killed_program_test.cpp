// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// `kill -9` at random moments of a real flight. A reader beside the flight, as a planner's would
// be, sees each batch as it is committed; all that it saw must be in the file afterwards.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/support/run_program.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kKills = 10;
constexpr std::chrono::milliseconds kMaxLoss = 1000ms;

/// What a reader saw committed while the flight went on.
struct Seen {
  std::uint64_t frames = 0;
  std::size_t blocks = 0;
  Clock::time_point last_batch = Clock::now();
};

Seen watch(const std::filesystem::path& path, Clock::time_point end) {
  Seen seen;
  while (Clock::now() < end) {
    std::this_thread::sleep_for(10ms);
    const auto map = load_map(path);
    EXPECT_TRUE(map) << map.error().text();
    if (!map || map->frames() <= seen.frames) continue;
    seen = {map->frames(), map->block_count(), Clock::now()};
  }
  return seen;
}

TEST(KilledProgram, leaves_a_good_map_with_everything_up_to_the_last_batch) {
  Random random;
  std::vector<std::chrono::duration<double>> losses;
  for (int kill = 0; kill < kKills; ++kill) {
    const TempFolder folder;
    RunningProgram flight({"map", "sim:apartment", "-o", "a.swl"}, folder.path());
    ASSERT_TRUE(flight.wait_for_file("a.swl")) << flight.wait().err;
    const auto delay = std::chrono::milliseconds(random.integer(0, 2000));
    const Seen seen = watch(folder / "a.swl", Clock::now() + delay);
    flight.send(SIGKILL);
    // What was mapped after the last batch is lost; a flight as young as that tells nothing.
    if (delay > kMaxLoss) losses.emplace_back(Clock::now() - seen.last_batch);
    EXPECT_EQ(flight.wait().exit_code, 128 + SIGKILL) << "the flight ended by itself";

    const Ended check = run({"check", "a.swl"}, folder.path());
    EXPECT_EQ(check.exit_code, 0) << check.err << random.repeat();
    const Ended told = run({"info", "a.swl", "--json"}, folder.path());
    ASSERT_EQ(told.exit_code, 0) << told.err << random.repeat();
    const auto info = nlohmann::json::parse(told.out);
    EXPECT_GE(info.at("frames"), seen.frames) << random.repeat();
    EXPECT_GE(info.at("blocks"), seen.blocks) << random.repeat();
  }
  // The median, since a busy machine may hold up one flight or another.
  if (losses.empty()) return;
  std::ranges::sort(losses);
  EXPECT_LE(losses[losses.size() / 2], kMaxLoss) << random.repeat();
}

}  // namespace
}  // namespace swiftlet::test
