// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/joined_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

template <class Sample, class Base>
class Played final : public Base {
 public:
  explicit Played(std::vector<Sample> samples) : samples_(std::move(samples)) {}
  Expected<std::optional<Sample>> next() override {
    if (at_ == samples_.size()) return std::nullopt;
    return samples_[at_++];
  }

 private:
  std::vector<Sample> samples_;
  std::size_t at_ = 0;
};
using Images = Played<DepthFrame, DepthStream>;
using Poses = Played<PoseSample, PoseStream>;

/// The time that the clock of a recording shows at a true time: it is set now and then.
struct RecordingClock {
  std::vector<std::pair<double, double>> sets{};  // when [s], by [s]
  [[nodiscard]] Stamp at(double t_s) const {
    double shown_s = 1.5e9 + t_s;
    for (const auto& [when_s, by_s] : sets) shown_s += t_s >= when_s ? by_s : 0.0;
    return Stamp{std::llround(shown_s * 1e9)};
  }
};

/// A flight along x at 1 m/s: the image of time t holds t in ms in its one pixel.
struct Flight {
  RecordingClock clock;
  double length_s = 10.0;
  std::vector<DepthFrame> images() const {
    std::vector<DepthFrame> images;
    for (int i = 1; i < length_s * 30; ++i) {
      DepthFrame frame{clock.at(i / 30.0),
                       {Image<std::uint16_t>(1, 1), 0.001F},
                       PinholeIntrinsics::create(1, 1, 1, 1, 0, 0).value()};
      frame.depth.raw.at(0, 0) = static_cast<std::uint16_t>(std::lround(i / 30.0 * 1e3));
      images.push_back(std::move(frame));
    }
    return images;
  }
  std::vector<PoseSample> poses() const {
    std::vector<PoseSample> poses;
    for (int i = 0; i <= length_s * 100; ++i)
      poses.push_back({clock.at(i / 100.0), Eigen::Quaterniond::Identity(), {i / 100.0, 0, 0}});
    return poses;
  }
};

struct Landed {
  std::vector<Frame> frames;
  FrameTally tally;
  std::vector<RigEvent> events;
};

Landed fly(std::vector<std::vector<DepthFrame>> cameras, std::vector<PoseSample> poses) {
  RigOptions rig;
  rig.cameras.resize(cameras.size());
  std::vector<DepthStreamPtr> streams;
  for (auto& images : cameras) streams.push_back(std::make_unique<Images>(std::move(images)));
  for (std::size_t i = 0; i < cameras.size(); ++i) rig.cameras[i].name = std::to_string(i);
  JoinedSource source({"test", "+z", std::nullopt, std::nullopt}, std::move(streams),
                      std::make_unique<Poses>(std::move(poses)), rig);
  Landed landed;
  while (auto frame = source.next().value()) {
    const double t_s = 1e-3 * frame->depth.raw.at(0, 0);
    EXPECT_NEAR(frame->T_world_camera.translation().x(), t_s, 0.002) << "the pose of its own time";
    if (!landed.frames.empty() && cameras.size() == 1) {
      EXPECT_LT(landed.frames.back().stamp, frame->stamp);
    }
    landed.frames.push_back(std::move(*frame));
  }
  landed.tally = source.tally();
  landed.events = source.take_events();
  return landed;
}

TEST(JoinedSource, is_not_blinded_by_one_stamp_an_hour_ahead_of_a_pose_or_an_image) {
  const Flight flight;
  for (const double by_s : {3600.0, -3600.0, 20.0, -5.0}) {
    for (const std::size_t at : {0U, 1U, 50U, 298U}) {
      auto images = flight.images();
      images[at].stamp = images[at].stamp + Nanoseconds(std::llround(by_s * 1e9));
      const Landed landed = fly({images}, flight.poses());
      EXPECT_EQ(landed.frames.size(), 298U) << by_s << " s at image " << at;
      auto poses = flight.poses();
      poses[at].stamp = poses[at].stamp + Nanoseconds(std::llround(by_s * 1e9));
      const Landed other = fly({flight.images()}, poses);
      EXPECT_EQ(other.frames.size(), 299U) << by_s << " s at pose " << at;
      EXPECT_EQ(other.tally.poses_refused, 1U);
    }
  }
}

TEST(JoinedSource, goes_on_after_its_clock_was_set_back_and_pairs_nothing_across_it) {
  test::for_each_seed(30, [](test::Random& random) {
    Flight flight;
    std::size_t back = 0;
    for (double t_s = random.real(1.0, 3.0); t_s < 9.0; t_s += random.real(1.0, 3.0)) {
      const double by_s = random.real(1.0, 100.0) * (random.chance(0.3) ? 1 : -1);
      flight.clock.sets.emplace_back(t_s, by_s);
      back += by_s < 0 ? 1 : 0;
    }
    const Landed landed = fly({flight.images()}, flight.poses());
    EXPECT_GE(landed.frames.size() + 3 * flight.clock.sets.size(), 299U);
    EXPECT_EQ(landed.tally.pose_clock.back, back);
    EXPECT_EQ(landed.tally.image_clock.back, back);
  });
}

TEST(JoinedSource, does_not_call_the_tracker_silent_when_the_clock_is_set_ahead) {
  Flight flight;
  flight.clock.sets.emplace_back(4.0, 3600.0);
  const Landed landed = fly({flight.images()}, flight.poses());
  EXPECT_GE(landed.frames.size(), 296U);
  EXPECT_EQ(landed.tally.stale_alarms, 0U);
  EXPECT_EQ(landed.tally.image_clock.ahead, 1U);
}

TEST(JoinedSource, follows_a_set_clock_with_several_cameras_too) {
  Flight flight;
  flight.clock.sets.emplace_back(4.0, -30.0);
  const Landed landed = fly({flight.images(), flight.images()}, flight.poses());
  EXPECT_GE(landed.frames.size(), 598U - 8U);
}

TEST(JoinedSource, survives_a_camera_whose_clock_alone_is_set_for_a_while) {
  const Flight flight;
  auto images = flight.images();
  for (std::size_t i = 100; i < 110; ++i)
    images[i].stamp = images[i].stamp - std::chrono::minutes(1);
  const Landed landed = fly({images}, flight.poses());
  EXPECT_GE(landed.frames.size(), 299U - 14U);
}

TEST(JoinedSource, tells_since_when_a_second_camera_is_silent_and_that_it_is_back) {
  const Flight flight;
  auto dead = flight.images();
  dead.erase(dead.begin() + 90, dead.end());  // 3 s
  const Landed landed = fly({flight.images(), dead}, flight.poses());
  EXPECT_EQ(landed.frames.size(), 299U + 90U);
  ASSERT_EQ(landed.events.size(), 1U);
  EXPECT_EQ(landed.events[0].kind, RigEventKind::kStalled);
  EXPECT_EQ(landed.events[0].who, "camera '1'");
  EXPECT_THAT(landed.events[0].what, HasSubstr("since 2.97 s"));
  EXPECT_EQ(landed.tally.events[static_cast<std::size_t>(RigEventKind::kStalled)], 1U);

  auto paused = flight.images();
  paused.erase(paused.begin() + 90, paused.begin() + 210);
  const Landed back = fly({flight.images(), paused}, flight.poses());
  ASSERT_EQ(back.events.size(), 2U);
  EXPECT_EQ(back.events[1].kind, RigEventKind::kRestarted);
}

}  // namespace
}  // namespace swiftlet
