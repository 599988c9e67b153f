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

/// A real recording, and how well its frames must agree with each other. The first three move by
/// centimetres from frame to frame: 1.9 to 5.2 mm were measured, also by an independent program
/// (their README). The last two move by half a metre, so that hidden surfaces set the limit: 18 and
/// 43 mm. The limits leave a third more.
struct Recording {
  const char* name;
  std::size_t frames;
  double fx_px;
  std::size_t step;            ///< frame i is compared with frame i + step
  double median_limit_m;       ///< of |depth seen - depth predicted|
  double within_5cm_at_least;  ///< share of the pixels that both see

  friend std::ostream& operator<<(std::ostream& out, const Recording& r) { return out << r.name; }
};

class EveryRecording : public ::testing::TestWithParam<Recording> {
 protected:
  std::filesystem::path folder_ = test::recorded_folder(GetParam().name);
};

using Motion = Transform<Camera, Camera>;

/// |depth seen - depth predicted| [m] where both frames have a reading: points of `a` moved into
/// `b`. Surfaces that hide each other are among them: medians and shares stand that, means do not.
void add_disagreement_m(const Frame& a, const Frame& b, const Motion& T_b_a,
                        std::vector<double>& off_m) {
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
      off_m.push_back(std::abs(b.depth.depth_m(ub, vb) - p.z()));
    }
  }
}

struct Agreement {
  std::size_t pixels;
  double median_m;
  double within_5cm;
};

/// Over at most some 25 pairs of frames, evenly spread. `reading` turns the true motion between two
/// frames into the one to be judged.
Agreement agreement_of(const std::vector<Frame>& frames, std::size_t step,
                       Motion (*reading)(const Motion& T_b_a)) {
  const std::size_t stride = std::max<std::size_t>(1, frames.size() / 25);
  std::vector<double> off_m;
  for (std::size_t i = 0; i + step < frames.size(); i += stride) {
    const Frame &a = frames[i], &b = frames[i + step];
    add_disagreement_m(a, b, reading(b.T_world_camera.inverse() * a.T_world_camera), off_m);
  }
  std::ranges::sort(off_m);
  const auto within = std::ranges::upper_bound(off_m, 0.05) - off_m.begin();
  const auto pixels = static_cast<double>(std::max<std::size_t>(1, off_m.size()));
  return {off_m.size(), off_m.empty() ? 0.0 : off_m[off_m.size() / 2],
          static_cast<double>(within) / pixels};
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
  const auto as_read = agreement_of(frames, step, [](const Motion& T) { return T; });
  ASSERT_GT(as_read.pixels, 1000U) << "the frames must see common things";
  EXPECT_LT(as_read.median_m, GetParam().median_limit_m);
  EXPECT_GT(as_read.within_5cm, GetParam().within_5cm_at_least);

  // A wrong convention would not do: neither standing still nor moving the other way agrees so
  // well.
  const auto still = agreement_of(frames, step, [](const Motion&) { return Motion(); });
  const auto backwards = agreement_of(frames, step, [](const Motion& T) { return T.inverse(); });
  for (const Agreement& wrong : {still, backwards}) {
    EXPECT_LT(2 * as_read.median_m, wrong.median_m);
    EXPECT_GT(as_read.within_5cm, wrong.within_5cm);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Recorded, EveryRecording,
    ::testing::Values(Recording{"sevenscenes_room200", 200, 585.0, 1, 0.007, 0.95},
                      Recording{"realsense_f200_tabletop50", 50, 615.195, 5, 0.0026, 0.95},
                      Recording{"open3d_redwood5", 5, 525.0, 1, 0.007, 0.95},
                      Recording{"slambook2_xtion5", 5, 518.0, 1, 0.058, 0.45},
                      Recording{"sun3d_studyroom5", 5, 570.342, 1, 0.025, 0.55}),
    [](const auto& recording) { return std::string(recording.param.name); });

}  // namespace
}  // namespace swiftlet
