// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// `kill -9` at random moments of a real flight, and before the calls that change its files. A
// reader beside the flight, as a planner's would be, sees each batch as it is committed; all that
// it saw must be in the file afterwards.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/support/run_program.hpp"
#include "app/support/traced_program.hpp"
#include "support/recordings.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

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

class KilledAtACall : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(recording_ / "rec");
    write_seven_scenes(recording_ / "rec");
    command_ = {"map", "7scenes:" + (recording_ / "rec").string(), "-o", "a.swl"};
  }

  std::vector<std::string> files(std::string_view end) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_->path())) {
      if (entry.path().string().ends_with(end)) names.push_back(entry.path().filename());
    }
    return names;
  }
  /// What a map says of its flight; empty if there is none that can be read.
  std::string flight_of(const std::string& name) const {
    const auto map = load_map(*folder_ / name);
    if (!map) return {};
    const auto line = map->meta().find("flight");
    return line == map->meta().end() ? "none" : line->second;
  }
  /// Starts the command until it is killed before one of its calls or comes to its end.
  std::optional<TracedRun> start(int kill_at) const {
    return run_until_call(command_, folder_->path(), kill_at);
  }
  /// The same command once more works, with all that was there before still there.
  void expect_that_it_works_again() const {
    const Ended again = run(command_, folder_->path());
    if (again.exit_code == 2 && !is_replacing_) {  // it was killed when all was done
      EXPECT_THAT(again.err, ::testing::HasSubstr("a.swl: the file exists"));
    } else {
      EXPECT_EQ(again.exit_code, 0) << again.err;
    }
    EXPECT_EQ(flight_of("a.swl"), "saved");
    EXPECT_EQ(load_map(*folder_ / "a.swl")->frames(), 3U);
    EXPECT_EQ(content_of(*folder_ / "a.swl.bak"), "the user's own");
    EXPECT_THAT(files(".old.swl"), ::testing::IsEmpty());
    for (const std::string& kept : files("swl")) {
      EXPECT_EQ(run({"check", kept}, folder_->path()).exit_code, 0) << kept;
    }
  }
  void begin_anew() {
    folder_.emplace();
    write_file(*folder_ / "a.swl.bak", "the user's own");
  }
  /// Kills now here, now there, in every part of the flight, in bounded time.
  void kill_everywhere(const std::function<void(int)>& expect_after_kill) {
    begin_anew();
    prepare_();
    const auto whole = start(0);
    if (!whole) GTEST_SKIP() << "this process may not trace another";
    ASSERT_EQ(whole->exit_code, 0);
    Random random;
    const int stride = std::max(1, whole->calls / kKillsAtCalls);
    for (int at = 1 + random.integer(0, stride - 1); at <= whole->calls; at += stride) {
      SCOPED_TRACE(
          fmt::format("killed before call {} of {}; {}", at, whole->calls, random.repeat()));
      begin_anew();
      prepare_();
      if (!start(at)->was_killed) continue;  // threads: the calls are not always as many
      expect_after_kill(at);
      start(random.integer(1, whole->calls));  // killed once more, or not
      expect_that_it_works_again();
    }
  }

  static constexpr int kKillsAtCalls = 25;
  TempFolder recording_;
  std::optional<TempFolder> folder_;
  std::vector<std::string> command_;
  bool is_replacing_ = false;
  std::function<void()> prepare_ = [] {};
};

TEST_F(KilledAtACall, the_same_command_works_again_and_what_was_mapped_is_kept) {
  kill_everywhere([&](int) {
    const auto map = load_map(*folder_ / "a.swl");
    if (!map || map->block_count() == 0 || flight_of("a.swl") != "under way") return;
    const Ended again = run(command_, folder_->path());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    const auto kept = files(".cut.swl");
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_THAT(again.err, ::testing::HasSubstr("kept as " + kept.front()));
    EXPECT_GT(load_map(*folder_ / kept.front())->block_count(), 0U);
    std::filesystem::remove(*folder_ / "a.swl");
  });
}

TEST_F(KilledAtACall, the_map_that_was_to_be_replaced_is_there_until_the_new_one_is_saved) {
  begin_anew();
  std::vector<std::string> first = command_;
  first.insert(first.end(), {"--frames", "1"});
  ASSERT_EQ(run(first, folder_->path()).exit_code, 0);
  const std::string old = content_of(*folder_ / "a.swl");
  command_.emplace_back("--overwrite");
  is_replacing_ = true;
  prepare_ = [&] { write_file(*folder_ / "a.swl", old); };
  kill_everywhere([&](int) {
    const auto names = files("swl");
    const bool is_there = std::ranges::any_of(
        names, [&](const std::string& name) { return content_of(*folder_ / name) == old; });
    EXPECT_TRUE(is_there || flight_of("a.swl") == "saved");
  });
}

}  // namespace
}  // namespace swiftlet::test
