// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The live source on the real SDK's software devices: depth through the SDK, poses over UDP, as
// 2.13's software device has none; cables are pulled, cameras hang. No camera is needed.

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "source/software_camera.hpp"
#include "source/udp_sender.hpp"
#include "support/map_bits.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/source/live_rig.hpp"
#include "swiftlet/source/pose_line.hpp"
#include "swiftlet/source/realsense_rig_private.hpp"

namespace swiftlet {
namespace {

using namespace test;
using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr const char* kOneCamera = "cameras: [{name: front, mount: intel_t265_d435}]\n";
constexpr const char* kTwoCameras =
    "cameras:\n"
    "  - {name: front, mount: intel_t265_d435}\n"
    "  - {name: left, at_m: [0, 0.1, 0], yaw_deg: 30}\n";

/// Software devices that can be plugged in and out.
class SoftwareDevices final : public RealsenseDevices {
 public:
  std::vector<RealsenseDevice> list() override {
    const std::lock_guard lock(mutex_);
    return plugged_;
  }
  void on_removed(std::function<void(const WasRemoved&)> tell) override {
    const std::lock_guard lock(mutex_);
    tell_ = std::move(tell);
  }
  void plug(const SoftwareCamera& camera, const std::string& serial,
            const std::string& usb = "3.2") {
    const std::lock_guard lock(mutex_);
    RealsenseFacts facts = facts_of(camera.device());
    facts.serial = serial;
    facts.usb = usb;
    plugged_.push_back({camera.device(), std::move(facts)});
  }
  void unplug(const SoftwareCamera& camera) {
    const auto is_it = [&](const rs2::device& d) { return d.get() == camera.device().get(); };
    std::function<void(const WasRemoved&)> tell;
    {
      const std::lock_guard lock(mutex_);
      std::erase_if(plugged_, [&](const auto& device) { return is_it(device.device); });
      tell = tell_;
    }
    if (tell) tell(is_it);
  }

 private:
  std::mutex mutex_;
  std::vector<RealsenseDevice> plugged_;
  std::function<void(const WasRemoved&)> tell_;
};

class LiveFlight : public ::testing::Test {
 protected:
  LiveFlight() { devices_->plug(front_, "S1"); }
  ~LiveFlight() override { land(); }

  RealsenseRequest request(const std::string& serials, const char* rig) {
    write_file(folder_ / "rig.yaml", rig);
    auto parsed = parse_realsense(
        fmt::format("{}?profile={}x{}@30&poses=udp:{}&pose_axes=t265&rig={}", serials, kWidth,
                    kHeight, sender_.port(), (folder_ / "rig.yaml").string()));
    EXPECT_TRUE(parsed) << parsed.error().text();
    if (!parsed) return {};
    parsed->keeper = {.glance = milliseconds(5),
                      .first_sample = std::chrono::seconds(5),
                      .stalled_after = milliseconds(400)};
    return *parsed;
  }

  /// The cameras stream at 30 Hz and the tracker at 200 until land().
  void take_off(bool has_left = false) {
    const auto K = SoftwareCamera::intrinsics();
    const auto left = Transform<Body, Body>::trusted(
                          Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 6, Eigen::Vector3d::UnitZ())),
                          {0, 0.1, 0}) *
                      forward_looking_camera();
    world_ = std::thread([this, K, left, has_left] {
      double tracked_ms = kT0_ms - 100;
      for (int k = 0; !is_landed_; ++k) {
        const double t_ms = kT0_ms + 12.3 + k * 1000.0 / 30.0;
        for (; tracked_ms < t_ms + 10.0; tracked_ms += 5.0) {
          if (!is_tracker_silent_) send_pose(tracked_ms);
        }
        if (!is_front_silent_) front_.deliver(wall_seen_at(t_ms, K), t_ms, k + 1);
        if (has_left) left_.deliver(wall_seen_at(t_ms + 1.0, K, left), t_ms + 1.0, k + 1);
        std::this_thread::sleep_for(milliseconds(10));
      }
    });
  }
  void land() {
    is_landed_ = true;
    if (world_.joinable()) world_.join();
  }
  void send_pose(double t_ms) {
    const rs2_pose pose = pose_at(t_ms);
    const auto& q = pose.rotation;
    const auto& t = pose.translation;
    sender_.send(pose_line({{std::llround(t_ms * 1e6)}, {q.w, q.x, q.y, q.z}, {t.x, t.y, t.z}}));
  }

  /// Flies on and holds each frame against the wall; false if the source ends.
  static bool fly(FrameSource& source, int frames) {
    for (int i = 0; i < frames; ++i) {
      const auto frame = source.next();
      EXPECT_TRUE(frame) << frame.error().text();
      if (!frame || !*frame) return false;
      EXPECT_LT(worst_off_the_wall_m(**frame), kWallTolerance_m);
    }
    return true;
  }
  /// The software device is not made to be stopped while it is fed: this waits until the keeper has
  /// done its work.
  template <class Live>
  static bool wait_for(Live& live, RigEventKind kind) {
    for (int i = 0; i < 2000; ++i) {
      for (const RigEvent& event : live.take_events()) {
        if (event.kind == kind && event.who == "camera 'front'") return true;
      }
      std::this_thread::sleep_for(milliseconds(5));
    }
    return false;
  }
  void pause() {
    is_front_silent_ = true;
    std::this_thread::sleep_for(milliseconds(60));
  }
  FrameSourcePtr open(const RealsenseRequest& asked) {
    auto source = open_realsense(devices_, asked);
    EXPECT_TRUE(source) << source.error().text();
    if (!source) return nullptr;
    EXPECT_TRUE(wait_for(**source, RigEventKind::kStarted));
    return std::move(*source);
  }
  static std::size_t count(const FrameSource& source, RigEventKind kind) {
    return source.tally().events[static_cast<std::size_t>(kind)];
  }
  TempFolder folder_;
  UdpSender sender_;
  SoftwareCamera front_, left_;
  std::shared_ptr<SoftwareDevices> devices_ = std::make_shared<SoftwareDevices>();
  std::atomic<bool> is_front_silent_ = false, is_tracker_silent_ = false, is_landed_ = false;
  std::thread world_;
};

TEST_F(LiveFlight, joins_depth_of_the_sdk_with_poses_from_anywhere) {
  const auto source = open(request("S1", kOneCamera));
  ASSERT_TRUE(source);
  EXPECT_NEAR(source->info().baseline_m.value_or(0.0), 0.05, 1e-9);
  take_off();
  EXPECT_TRUE(fly(*source, 10));
  ASSERT_NE(source->facts(), nullptr);
  EXPECT_GE(source->facts()->cameras.front().samples, 10U);
  EXPECT_NEAR(source->facts()->poses.rate_hz(), 200.0, 1.0);
  land();
}

TEST_F(LiveFlight, goes_on_when_the_camera_was_unplugged_and_is_back) {
  const auto source = open(request("S1", kOneCamera));
  ASSERT_TRUE(source);
  take_off();
  EXPECT_TRUE(fly(*source, 3));
  pause();
  devices_->unplug(front_);
  EXPECT_TRUE(wait_for(*source, RigEventKind::kNotStarted));
  devices_->plug(front_, "S1");
  EXPECT_TRUE(wait_for(*source, RigEventKind::kRestarted));
  is_front_silent_ = false;
  EXPECT_TRUE(fly(*source, 5));
  EXPECT_EQ(count(*source, RigEventKind::kUnplugged), 1U);
  EXPECT_EQ(count(*source, RigEventKind::kRestarted), 1U);
  land();
}

TEST_F(LiveFlight, starts_a_camera_again_that_hangs) {
  const auto source = open(request("S1", kOneCamera));
  ASSERT_TRUE(source);
  take_off();
  EXPECT_TRUE(fly(*source, 3));
  pause();
  EXPECT_TRUE(wait_for(*source, RigEventKind::kRestarted));
  is_front_silent_ = false;
  EXPECT_TRUE(fly(*source, 5));
  EXPECT_EQ(count(*source, RigEventKind::kStalled), 1U);
  land();
}

TEST_F(LiveFlight, tells_of_a_pose_source_that_falls_silent_and_goes_on_when_it_is_back) {
  const auto source = open(request("S1", kOneCamera));
  ASSERT_TRUE(source);
  take_off();
  EXPECT_TRUE(fly(*source, 3));
  is_tracker_silent_ = true;
  std::this_thread::sleep_for(milliseconds(800));
  is_tracker_silent_ = false;
  EXPECT_TRUE(fly(*source, 10));
  EXPECT_EQ(count(*source, RigEventKind::kStalled), 1U);
  FrameTally tally = source->tally();
  EXPECT_GE(tally.of(FrameLoss::kPoseGap) + tally.of(FrameLoss::kNoPose) +
                tally.of(FrameLoss::kPoseStale),
            1U)
      << "nothing is mapped without a pose";
  land();
}

TEST_F(LiveFlight, warns_of_a_slow_port_and_maps_what_it_brings) {
  devices_->unplug(front_);
  devices_->plug(front_, "S1", "2.1");
  auto source = open_realsense(devices_, request("S1", kOneCamera));
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_TRUE(wait_for(**source, RigEventKind::kSlowUsb));
  std::this_thread::sleep_for(milliseconds(200));
  take_off();
  EXPECT_TRUE(fly(**source, 3));
  EXPECT_EQ(count(**source, RigEventKind::kSlowUsb), 1U);
  land();
}

TEST_F(LiveFlight, maps_with_two_cameras_and_goes_on_with_one) {
  devices_->plug(left_, "S2");
  const auto source = open(request("S1,S2", kTwoCameras));
  ASSERT_TRUE(source);
  std::this_thread::sleep_for(milliseconds(200));  // the other one, too
  take_off(true);
  std::array<int, 2> by_camera{};
  for (int i = 0; i < 20; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_LT(worst_off_the_wall_m(**frame), kWallTolerance_m) << "each behind its own mount";
    ++by_camera[(*frame)->camera];
  }
  EXPECT_GE(by_camera[0], 3);
  EXPECT_GE(by_camera[1], 3);
  pause();
  devices_->unplug(front_);
  EXPECT_TRUE(wait_for(*source, RigEventKind::kUnplugged));
  EXPECT_TRUE(fly(*source, 5)) << "with the other one";
  land();
}

TEST_F(LiveFlight, takes_cameras_without_serial_numbers_as_they_come_and_none_twice) {
  auto two = request("", kTwoCameras);
  auto source = open_realsense(devices_, two);
  ASSERT_FALSE(source) << "there is one";
  EXPECT_THAT(source.error().text(), HasSubstr("connected are: S1"));
  devices_->plug(left_, "S2");
  EXPECT_TRUE(open_realsense(devices_, two));
}

TEST_F(LiveFlight, that_is_recorded_by_the_sdk_replays_to_the_same_map) {
  const auto asked = request("S1", kOneCamera);
  const auto K = SoftwareCamera::intrinsics();
  auto mapper = Mapper::create({});
  ASSERT_TRUE(mapper);
  std::vector<Frame> live_frames;
  {
    auto recording = record_realsense(devices_, asked, folder_ / "rec");
    ASSERT_TRUE(recording) << recording.error().text();
    // The same instruments, live.
    LiveRig rig(SourceInfo{"live:", "+z", std::nullopt, std::nullopt},
                {.rig = asked.rig.rig, .queue = {.capacity = 100}});
    EXPECT_TRUE(wait_for(**recording, RigEventKind::kStarted));
    for (double t_ms = kT0_ms - 100.0; t_ms < kT0_ms + 400.0; t_ms += 5.0) {
      send_pose(t_ms);
      take_pose(pose_at(t_ms), t_ms, RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, rig);
    }
    for (int k = 0; k < 10; ++k) {
      const double t_ms = kT0_ms + 12.0 + 33.0 * k;
      const auto pixels = wall_seen_at(t_ms, K);
      front_.deliver(pixels, t_ms, k + 1);
      DepthImage depth{Image<std::uint16_t>(kWidth, kHeight), 0.001F};
      std::ranges::copy(pixels, depth.raw.row(0).data());
      rig.push(
          DepthFrame{{std::llround(t_ms * 1e6)}, std::move(depth), K, 0, ClockDomain::kSystem});
      std::this_thread::sleep_for(milliseconds(20));
    }
    rig.close();
    while (true) {
      const auto frame = rig.next();
      ASSERT_TRUE(frame) << frame.error().text();
      if (!*frame) break;
      mapper->integrate(**frame);
      live_frames.push_back(std::move(**frame));
    }
    const auto streams = (*recording)->streams();
    ASSERT_EQ(streams.size(), 2U);
    EXPECT_EQ(streams[1].samples, 100U);
    EXPECT_EQ(streams[0].file.filename(), "depth_S1.bag");
  }
  const std::string replay = fmt::format(
      "bag:{0}/depth_S1.bag,{0}/poses.txt?pose_axes=t265&rig={1}",
      (folder_ / "rig.yaml").parent_path().string() + "/rec", (folder_ / "rig.yaml").string());
  auto replayed = open_source(replay);
  ASSERT_TRUE(replayed) << replayed.error().text();
  for (const Frame& live : live_frames) {
    const auto frame = (*replayed)->next();
    ASSERT_TRUE(frame && *frame);
    // The SDK rounds stamps to 0.24 us when it records.
    EXPECT_NEAR(seconds((*frame)->stamp - live.stamp), 0.0, 0.25e-6);
    EXPECT_LT(((*frame)->T_world_camera.translation() - live.T_world_camera.translation()).norm(),
              1e-6);
    EXPECT_EQ((*frame)->depth.unit_m, live.depth.unit_m);
    EXPECT_TRUE((*frame)->intrinsics == live.intrinsics);
    for (int v = 0; v < kHeight; ++v)
      ASSERT_TRUE(std::ranges::equal((*frame)->depth.raw.row(v), live.depth.raw.row(v)));
  }
  const MapBits live = bits_of(*mapper);
  EXPECT_EQ(live.frames, 10U);
  const auto again = folder_ / "rec";
  EXPECT_EQ(map_bits(fmt::format("bag:{0}/depth_S1.bag,{0}/poses.txt?pose_axes=t265&rig={1}",
                                 again.string(), (folder_ / "rig.yaml").string())),
            live);
  const auto refused = record_realsense(devices_, asked, again);
  ASSERT_FALSE(refused) << "recordings are not replaced";
  EXPECT_THAT(refused.error().text(), HasSubstr("the file exists"));
}

TEST(RealsenseAddress, answers_what_cannot_be_meant) {
  const auto answer = [](const char* rest) {
    const auto request = parse_realsense(rest);
    return request ? std::string("accepted") : request.error().text();
  };
  EXPECT_THAT(answer("?profile=big"), HasSubstr("WIDTHxHEIGHT@FPS"));
  EXPECT_THAT(answer("?poses=tcp:9"), HasSubstr("udp:PORT"));
  EXPECT_THAT(answer("?poses=udp:0"), HasSubstr("udp:PORT"));
  EXPECT_THAT(answer("?poses=udp:70000"), HasSubstr("udp:PORT"));
  EXPECT_THAT(answer("?poses=udp:5605"), HasSubstr("rig file")) << "Intel's bracket is a T265's";
  EXPECT_THAT(answer("S1,S2"), HasSubstr("2 serial numbers for 1 camera;"));
  EXPECT_EQ(answer("S1?wait_s=30"), "accepted");
}

}  // namespace
}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
