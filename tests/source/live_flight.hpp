// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "source/software_camera.hpp"
#include "source/udp_sender.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/source/live/live_rig.hpp"
#include "swiftlet/source/realsense/realsense_rig_private.hpp"
#include "swiftlet/source/rig/pose_line.hpp"

namespace swiftlet::test {

using std::chrono::milliseconds;

inline constexpr const char* kOneCamera = "cameras: [{name: front, mount: intel_t265_d435}]\n";

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
    DeviceInfo facts = facts_of(camera.device());
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
    parsed->keeper = {.poll_period = milliseconds(5),
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
  /// The flight that most tests disturb: one camera, in the air, three frames mapped.
  FrameSourcePtr fly_off() {
    auto source = open(request("S1", kOneCamera));
    if (!source) return nullptr;
    take_off();
    EXPECT_TRUE(fly(*source, 3));
    return source;
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

}  // namespace swiftlet::test
