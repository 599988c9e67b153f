// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/recordings.hpp"

namespace swiftlet::test {

inline constexpr std::int64_t kEpoch_s = 1305031102;

/// A camera that moves along the world's x at 1 m/s and turns about the world's z at 1 rad/s,
/// looking along y: interpolation must hit it exactly. Starts at kEpoch_s.
inline Transform<World, Camera> true_pose(double t_s) {
  Eigen::Matrix3d R_looking_along_y;
  R_looking_along_y << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(t_s, Eigen::Vector3d::UnitZ()));
  return Transform<World, Camera>::trusted(turn * Eigen::Quaterniond(R_looking_along_y),
                                           {t_s, 2, 1});
}

inline std::string pose_line(double t_s) {
  const auto T = true_pose(t_s);
  const auto& q = T.rotation();
  const auto& p = T.translation();
  return fmt::format("{}.{:06} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", kEpoch_s,
                     std::llround(t_s * 1e6), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

/// Images every 33.3 ms from 0 to 0.5 s, poses every 10 ms from 0.1 to 0.9 s.
class Tum : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "depth");
    write_file(folder_ / "camera-intrinsics.txt", kSmallCamera);
    for (int i = 0; i < 16; ++i) image(i * 1.0 / 30);
    for (int i = 10; i <= 90; ++i) poses_ += pose_line(0.01 * i);
    write_lists();
  }
  void image(double t_s) {
    const auto stamp = fmt::format("{}.{:06}", kEpoch_s, std::llround(t_s * 1e6));
    write_png(folder_ / ("depth/" + stamp + ".png"), flat(10000));
    images_ += stamp + " depth/" + stamp + ".png\n";
  }
  void write_lists() {
    write_file(folder_ / "depth.txt", images_);
    write_file(folder_ / "groundtruth.txt", poses_);
  }
  [[nodiscard]] std::string address() const { return "tum:" + folder_.path().string(); }
  [[nodiscard]] static std::size_t lost(FrameTally tally, FrameLoss loss) { return tally.of(loss); }

  TempFolder folder_;
  std::string images_ = "# depth maps\n# file: 'rgbd_dataset.bag'\n# timestamp filename\n";
  std::string poses_ = "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n";
};

inline void expect_true_poses(const std::vector<Frame>& frames) {
  for (const Frame& frame : frames) {
    const double t_s = seconds(frame.stamp - Stamp{kEpoch_s * 1'000'000'000});
    const auto expected = true_pose(t_s);
    EXPECT_LT((frame.T_world_camera.translation() - expected.translation()).norm(), 1e-9) << t_s;
    EXPECT_LT(frame.T_world_camera.rotation().angularDistance(expected.rotation()), 1e-7) << t_s;
  }
}

}  // namespace swiftlet::test
