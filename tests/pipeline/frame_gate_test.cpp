// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/frame_gate.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "support/bad_frames.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet {
namespace {

using test::Random;

Frame frame_of(DepthImage depth, double x_m = 0.0, std::uint8_t camera = 0) {
  const auto intrinsics = test::small_camera(depth.raw.width(), depth.raw.height());
  const auto T = Transform<World, Body>::trusted(Eigen::Quaterniond::Identity(), {x_m, 0, 0}) *
                 forward_looking_camera();
  Frame frame{Stamp{}, std::move(depth), intrinsics, T};
  frame.camera = camera;
  return frame;
}

Frame flat_frame(std::uint16_t value) {
  return frame_of({Image<std::uint16_t>(848, 480, value), 0.001F});
}

TEST(FrameGate, lets_good_frames_pass) {
  test::for_each_seed(10, [](Random& random) {
    FrameGate gate({});
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(gate.refusal(frame_of(test::boxes_before_a_wall(random), 0.05 * i)), std::nullopt);
  });
}

TEST(FrameGate, refuses_each_kind_of_bad_frame_by_its_name) {
  Random random;
  FrameGate gate({});
  EXPECT_EQ(gate.refusal(flat_frame(0)), FrameVerdict::kNoReadings);
  EXPECT_EQ(gate.refusal(flat_frame(65535)), FrameVerdict::kSaturated);
  Frame empty = flat_frame(0);
  for (int u = 0; u < 800; ++u) empty.depth.raw.at(u, 3) = 1500;
  EXPECT_EQ(gate.refusal(empty), FrameVerdict::kMostlyEmpty);
  const DepthImage sharp = test::boxes_before_a_wall(random);
  EXPECT_EQ(gate.refusal(frame_of(test::smeared(sharp, 7, 0))), FrameVerdict::kSmeared);
  EXPECT_EQ(gate.refusal(frame_of(test::smeared(sharp, 0, 7))), FrameVerdict::kSmeared);
  EXPECT_EQ(gate.refusal(frame_of(sharp)), std::nullopt);
}

TEST(FrameGate, refuses_a_frozen_image_once_the_camera_has_moved_and_until_it_lives_again) {
  Random random;
  FrameGate gate({});
  const DepthImage image = test::boxes_before_a_wall(random);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(gate.refusal(frame_of(image)), std::nullopt) << "nothing moves: no harm";
  EXPECT_EQ(gate.refusal(frame_of(image, 0.2)), FrameVerdict::kFrozen);
  EXPECT_EQ(gate.refusal(frame_of(image, 0.3)), FrameVerdict::kFrozen);
  EXPECT_EQ(gate.refusal(frame_of(image, 0.3, 1)), std::nullopt) << "another camera";
  EXPECT_EQ(gate.refusal(frame_of(test::boxes_before_a_wall(random), 0.3)), std::nullopt);

  FrameGate flying({});
  int used = 0;
  for (int i = 0; i < 20; ++i) used += flying.refusal(frame_of(image, 0.2 * i)) ? 0 : 1;
  EXPECT_EQ(used, QualityLimits{}.max_frozen);
}

TEST(FrameGate, refuses_two_or_more_frozen_images_in_turn) {
  for (const int in_turn : {2, 3, 4}) {
    Random random;
    std::vector<DepthImage> images;
    for (int i = 0; i < in_turn; ++i) images.push_back(test::boxes_before_a_wall(random));
    FrameGate gate({});
    int used = 0;
    for (int i = 0; i < 40; ++i) {
      const auto& image = images[static_cast<std::size_t>(i % in_turn)];
      used += gate.refusal(frame_of(image, 0.05 * i)) ? 0 : 1;
    }
    EXPECT_LE(used, in_turn + QualityLimits{}.max_frozen);
    EXPECT_EQ(gate.refusal(frame_of(test::boxes_before_a_wall(random), 3.0)), std::nullopt);
  }
}

TEST(FrameGate, refuses_white_noise_in_every_pixel_or_in_half_of_them) {
  test::for_each_seed(5, [](Random& random) {
    for (const int nearest : {1, 300}) {
      for (const double share : {1.0, 0.5}) {
        Frame noise = flat_frame(0);
        for (std::uint16_t& z : noise.depth.raw.pixels()) {
          if (random.chance(share))
            z = static_cast<std::uint16_t>(random.integer(nearest, nearest == 1 ? 65534 : 6000));
        }
        FrameGate gate({});
        EXPECT_EQ(gate.refusal(noise), FrameVerdict::kNoise) << nearest << " " << share;
        QualityLimits none;
        none.max_rough = 1.0;
        EXPECT_EQ(FrameGate(none).refusal(noise), std::nullopt);
      }
    }
  });
}

TEST(FrameGate, each_limit_can_be_set_and_be_taken_away) {
  Random random;
  const DepthImage sharp = test::boxes_before_a_wall(random);
  const auto verdict = [](const QualityLimits& limits, const Frame& frame) {
    return FrameGate(limits).refusal(frame);
  };
  QualityLimits none{0.0, 1.0, 1.0, 1.0, 0};
  EXPECT_EQ(verdict(none, flat_frame(65535)), std::nullopt);
  EXPECT_EQ(verdict(none, frame_of(test::smeared(sharp, 7, 0))), std::nullopt);
  FrameGate gate(none);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(gate.refusal(frame_of(sharp, 0.2 * i)), std::nullopt);
  none.min_valid = 1.0;
  Frame one_hole = flat_frame(1000);
  one_hole.depth.raw.at(5, 5) = 0;
  EXPECT_EQ(verdict(none, one_hole), FrameVerdict::kMostlyEmpty);
  none = {0.0, 1.0, 0.5, 1.0, 0};
  EXPECT_EQ(verdict(none, flat_frame(1000)), FrameVerdict::kSaturated) << "all of one value";
  EXPECT_EQ(verdict(none, frame_of(sharp)), std::nullopt);
}

TEST(FrameGate, stands_before_the_map) {
  Random random;
  MapperConfig config;
  auto mapper = Mapper::create(config).value();
  const DepthImage sharp = test::boxes_before_a_wall(random);
  EXPECT_EQ(mapper.integrate(frame_of(test::smeared(sharp, 7, 0))).verdict, FrameVerdict::kSmeared);
  EXPECT_EQ(mapper.frame_count(), 0U);
  EXPECT_EQ(mapper.integrate(frame_of(sharp)).verdict, FrameVerdict::kIntegrated);
  config.quality.max_smeared = 1.0;
  auto tolerant = Mapper::create(config).value();
  EXPECT_EQ(tolerant.integrate(frame_of(test::smeared(sharp, 7, 0))).verdict,
            FrameVerdict::kIntegrated);
}

}  // namespace
}  // namespace swiftlet
