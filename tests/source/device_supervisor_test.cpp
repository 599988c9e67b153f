// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live/device_supervisor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "support/no_threads.hpp"
#include "swiftlet/source/live/live_rig.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

const DeviceSupervisor::Options kQuick{.poll_period = milliseconds(2),
                                       .first_sample = milliseconds(2000),
                                       .stalled_after = milliseconds(300)};

/// A camera whose cable can be pulled and whose firmware can hang: a driver's thread of its own
/// delivers images into the rig every 2 ms, as long as it is well.
class ShakyCamera {
 public:
  explicit ShakyCamera(LiveRig& rig) : rig_(rig) {}

  LiveInstrument instrument() {
    return {"camera 'front'",
            [this]() -> Expected<LiveStreamPtr> {
              if (!is_plugged) return fail(ErrorCode::kNotFound, "front", "no such camera");
              ++starts;
              is_hanging = false;  // a restart cures it
              return std::make_unique<Stream>(*this);
            },
            [this] { return rig_.last_image(0); }};
  }

  std::atomic<bool> is_plugged = true;
  std::atomic<bool> is_hanging = false;
  std::atomic<int> starts = 0;

 private:
  class Stream final : public LiveStream {
   public:
    explicit Stream(ShakyCamera& camera) : thread_([this, &camera] { camera.stream(is_over_); }) {}
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() override {
      is_over_ = true;
      thread_.join();
    }

   private:
    std::atomic<bool> is_over_ = false;
    std::thread thread_;
  };
  void stream(const std::atomic<bool>& is_over) {
    while (!is_over) {
      if (is_plugged && !is_hanging) {
        const Stamp stamp{milliseconds(2 * ++images_) / std::chrono::nanoseconds(1)};
        rig_.push(PoseSample{stamp, Eigen::Quaterniond::Identity(), {0, 0, 0}});
        rig_.push(
            DepthFrame{stamp, DepthImage{}, PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value()});
      }
      std::this_thread::sleep_for(milliseconds(2));
    }
  }

  LiveRig& rig_;
  std::atomic<int> images_ = 0;
};

class Keeper : public ::testing::Test {
 protected:
  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      const auto frame = rig_.next();
      ASSERT_TRUE(frame) << frame.error().text();
      ASSERT_TRUE(*frame);
    }
  }
  std::size_t count(RigEventKind kind) const {
    return rig_.tally().events[static_cast<std::size_t>(kind)];
  }
  /// Maps on until an event of that kind has been told; false if none comes.
  bool fly_until(RigEventKind kind, std::size_t times = 1) {
    for (int i = 0; i < 3000 && count(kind) < times; ++i) frames(1);
    return count(kind) >= times;
  }

  LiveRig rig_{SourceInfo{"live:", "+z", std::nullopt, std::nullopt},
               {.rig = {}, .queue = {}, .timeout = std::chrono::seconds(10)}};
  ShakyCamera camera_{rig_};
};

TEST_F(Keeper, starts_what_was_unplugged_again_and_the_flight_goes_on) {
  const auto keeper = DeviceSupervisor::start(rig_, {camera_.instrument()}, kQuick).value();
  frames(3);
  camera_.is_plugged = false;
  keeper->note_unplugged(0);
  std::thread hand([this] {
    std::this_thread::sleep_for(milliseconds(100));
    camera_.is_plugged = true;
  });
  EXPECT_TRUE(fly_until(RigEventKind::kRestarted));
  hand.join();
  frames(3);
  EXPECT_EQ(count(RigEventKind::kUnplugged), 1U);
  EXPECT_EQ(count(RigEventKind::kNotStarted), 1U) << "tried many times, told once";
  EXPECT_EQ(camera_.starts, 2);
  const auto events = rig_.take_events();
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[0].kind, RigEventKind::kStarted);
  EXPECT_EQ(events[1].kind, RigEventKind::kUnplugged);
  EXPECT_EQ(events[1].who, "camera 'front'");
  EXPECT_THAT(events[2].what, HasSubstr("no such camera"));
}

#ifdef SWIFTLET_CAN_LACK_THREADS
TEST_F(Keeper, says_so_if_the_system_has_no_thread_for_it) {
  const test::NoThreads none;
  const auto keeper = DeviceSupervisor::start(rig_, {camera_.instrument()}, kQuick);
  ASSERT_FALSE(keeper);
  EXPECT_EQ(keeper.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(camera_.starts, 0);
}
#endif

TEST_F(Keeper, starts_what_says_nothing_any_more_again) {
  const auto keeper = DeviceSupervisor::start(rig_, {camera_.instrument()}, kQuick).value();
  frames(3);
  camera_.is_hanging = true;
  EXPECT_TRUE(fly_until(RigEventKind::kRestarted));
  frames(3);
  EXPECT_EQ(count(RigEventKind::kStalled), 1U);
  EXPECT_EQ(camera_.starts, 2);
}

TEST_F(Keeper, tells_once_of_a_silence_that_no_restart_cures) {
  auto instrument = camera_.instrument();
  instrument.can_restart = false;
  const auto keeper = DeviceSupervisor::start(rig_, {std::move(instrument)}, kQuick).value();
  frames(3);
  camera_.is_hanging = true;
  std::this_thread::sleep_for(milliseconds(800));  // twice as long as it takes
  camera_.is_hanging = false;
  EXPECT_TRUE(fly_until(RigEventKind::kRestarted));
  EXPECT_EQ(count(RigEventKind::kStalled), 1U);
  EXPECT_EQ(camera_.starts, 1);
}

TEST_F(Keeper, does_not_take_one_instrument_for_another) {
  ShakyCamera other(rig_);
  auto dead = other.instrument();
  dead.name = "T265";
  dead.last_sample = [] { return std::optional<HostTime>(); };
  auto options = kQuick;
  options.first_sample = milliseconds(30);
  other.is_hanging = true;
  const auto keeper =
      DeviceSupervisor::start(rig_, {camera_.instrument(), std::move(dead)}, options).value();
  EXPECT_TRUE(fly_until(RigEventKind::kStalled, 2)) << "started again and again";
  EXPECT_EQ(camera_.starts, 1) << "the other one is well";
  for (const RigEvent& event : rig_.take_events()) {
    if (event.kind != RigEventKind::kStalled) continue;
    EXPECT_EQ(event.who, "T265");
  }
}

TEST(LiveRig, ends_when_it_is_asked_to_while_no_frame_comes) {
  LiveRig rig(SourceInfo{"live:", "+z", std::nullopt, std::nullopt}, {});
  bool is_unwanted = false;
  rig.stop_when([&] { return std::exchange(is_unwanted, true); });
  const auto frame = rig.next();
  ASSERT_TRUE(frame) << "no error: somebody wants to go home";
  EXPECT_FALSE(*frame);
}

TEST(LiveRig, keeps_the_memory_for_events_bounded_and_counts_all) {
  LiveRig rig(SourceInfo{"live:", "+z", std::nullopt, std::nullopt}, {});
  for (int i = 0; i < 1000; ++i) rig.note({RigEventKind::kBadPose, "poses", "no number"});
  rig.close();
  ASSERT_TRUE(rig.next());
  EXPECT_EQ(rig.tally().events[static_cast<std::size_t>(RigEventKind::kBadPose)], 1000U);
  EXPECT_EQ(rig.take_events().size(), 100U);
  EXPECT_TRUE(rig.take_events().empty());
}

}  // namespace
}  // namespace swiftlet
