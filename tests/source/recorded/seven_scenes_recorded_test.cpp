// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "support/recorded.hpp"
#include "support/recordings.hpp"

namespace swiftlet {
namespace {

/// A real recording, and how well its frames agree with each other (from its own README, measured
/// by an independent program; the limits leave a third more).
struct Recording {
  const char* name;
  std::size_t frames;
  double fx_px;
  std::size_t step;            ///< frame i is compared with frame i + step
  double median_limit_m;       ///< of |depth seen - depth predicted|
  double within_5cm_at_least;  ///< share of the co-visible pixels

  friend std::ostream& operator<<(std::ostream& out, const Recording& r) { return out << r.name; }
};

class EveryRecording : public ::testing::TestWithParam<Recording> {
 protected:
  std::filesystem::path folder_ = test::recorded_folder(GetParam().name);
};

/// |depth seen - depth predicted| [m] where both frames have a reading: points of `a` moved into
/// `b`. Points that `b` sees more than 0.3 m in front of are hidden, not wrong.
std::vector<double> disagreement_m(const Frame& a, const Frame& b) {
  const auto T_b_a = b.T_world_camera.inverse() * a.T_world_camera;
  std::vector<double> off_m;
  for (int v = 0; v < a.depth.raw.height(); v += 4) {
    for (int u = 0; u < a.depth.raw.width(); u += 4) {
      if (a.depth.raw.at(u, v) == 0) continue;
      const Eigen::Vector3d p = T_b_a * a.intrinsics.back_project(u, v, a.depth.depth_m(u, v));
      if (p.z() < 0.1) continue;
      const Eigen::Vector2d pixel = b.intrinsics.project(p);
      const int ub = static_cast<int>(std::lround(pixel.x()));
      const int vb = static_cast<int>(std::lround(pixel.y()));
      const bool is_inside =
          ub >= 0 && vb >= 0 && ub < b.depth.raw.width() && vb < b.depth.raw.height();
      if (!is_inside || b.depth.raw.at(ub, vb) == 0) continue;
      const double off = std::abs(b.depth.depth_m(ub, vb) - p.z());
      if (off < 0.3) off_m.push_back(off);
    }
  }
  return off_m;
}

TEST_P(EveryRecording, is_read_to_its_end_with_unit_poses) {
  SWIFTLET_NEEDS_RECORDING(folder_);
  const auto reading = test::read_all("7scenes:" + folder_.string());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.frames.size(), GetParam().frames);
  for (const Frame& frame : reading.frames) {
    EXPECT_NEAR(frame.T_world_camera.rotation().norm(), 1.0, 1e-12);
    EXPECT_EQ(frame.intrinsics.width(), 640);
    EXPECT_EQ(frame.intrinsics.height(), 480);
    EXPECT_NEAR(frame.intrinsics.fx(), GetParam().fx_px, 0.01);
  }
}

TEST_P(EveryRecording, agrees_with_itself_from_frame_to_frame) {
  SWIFTLET_NEEDS_RECORDING(folder_);
  const auto frames = test::read_all("7scenes:" + folder_.string()).frames;
  const std::size_t step = GetParam().step;
  std::vector<double> off_m;
  for (std::size_t i = 0; i + step < frames.size(); i += step) {
    const auto pair = disagreement_m(frames[i], frames[i + step]);
    off_m.insert(off_m.end(), pair.begin(), pair.end());
  }
  ASSERT_GT(off_m.size(), 1000U) << "the frames must see common things";
  std::ranges::sort(off_m);
  const auto within = std::ranges::upper_bound(off_m, 0.05) - off_m.begin();
  const double share = static_cast<double>(within) / static_cast<double>(off_m.size());
  RecordProperty("median_mm", std::to_string(1000 * off_m[off_m.size() / 2]));
  RecordProperty("within_5cm", std::to_string(share));
  EXPECT_LT(off_m[off_m.size() / 2], GetParam().median_limit_m);
  EXPECT_GT(share, GetParam().within_5cm_at_least);
}

INSTANTIATE_TEST_SUITE_P(
    Recorded, EveryRecording,
    ::testing::Values(Recording{"sevenscenes_room200", 200, 585.0, 1, 0.02, 0.8},
                      Recording{"realsense_f200_tabletop50", 50, 615.195, 5, 0.0026, 0.95},
                      Recording{"open3d_redwood5", 5, 525.0, 1, 0.007, 0.95},
                      Recording{"slambook2_xtion5", 5, 518.0, 1, 0.028, 0.7},
                      Recording{"sun3d_studyroom5", 5, 570.342, 1, 0.016, 0.75}),
    [](const auto& recording) { return std::string(recording.param.name); });

}  // namespace
}  // namespace swiftlet
