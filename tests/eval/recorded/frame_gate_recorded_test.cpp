// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The gate before the map knows good frames: every real recording.

#include <gtest/gtest.h>

#include "support/recorded.hpp"
#include "swiftlet/eval/camera/depth_recording.hpp"
#include "swiftlet/pipeline/frame_gate.hpp"

namespace swiftlet {
namespace {

class GoodRecording : public testing::TestWithParam<const char*> {};

TEST_P(GoodRecording, has_no_frame_that_is_refused) {
  const std::string address = GetParam();
  const std::size_t colon = address.find(':');
  const auto place = test::recorded_folder(address.substr(colon + 1));
  SWIFTLET_NEEDS_RECORDING(place.has_extension() ? place.parent_path() : place);
  auto recording = eval::open_depth_recording(address.substr(0, colon + 1) +
                                              std::filesystem::absolute(place).string());
  ASSERT_TRUE(recording) << recording.error().text();
  FrameGate gate({});
  std::size_t frames = 0;
  for (;;) {
    auto depth = recording->stream->next();
    ASSERT_TRUE(depth) << depth.error().text();
    if (!*depth) break;
    ++frames;
    // A camera that flies 0.2 m from image to image: equal ones would be frozen.
    const auto T = Transform<World, Camera>::trusted(Eigen::Quaterniond::Identity(),
                                                     {0.2 * static_cast<double>(frames), 0.0, 0.0});
    const auto refusal = gate.refusal({(*depth)->stamp, (*depth)->depth, (*depth)->intrinsics, T});
    EXPECT_FALSE(refusal) << "frame " << frames << ": "
                          << kFrameVerdictNames[static_cast<std::size_t>(*refusal)];
  }
  EXPECT_GE(frames, 2U);
}

INSTANTIATE_TEST_SUITE_P(, GoodRecording,
                         testing::Values("7scenes:sevenscenes_room200",
                                         "7scenes:realsense_f200_tabletop50",
                                         "7scenes:open3d_redwood5", "7scenes:slambook2_xtion5",
                                         "7scenes:sun3d_studyroom5",
                                         "bag:bags/librealsense_single_depth_color_640x480.bag"));

}  // namespace
}  // namespace swiftlet
