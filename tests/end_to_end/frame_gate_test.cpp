// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The gate before the map knows good frames: all flights of the built-in scenes.

#include "swiftlet/pipeline/frame_gate.hpp"

#include <gtest/gtest.h>

#include "swiftlet/sim/built_in_scenes.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, has_no_frame_that_is_refused) {
  for (const char* options : {"?rate=1", "?rate=1&noise=off", "?rate=1&barrel=0.1"}) {
    auto source = open_source("sim:" + GetParam() + options);
    ASSERT_TRUE(source) << source.error().text();
    FrameGate gate({});
    std::size_t frames = 0;
    for (;;) {
      const auto frame = (*source)->next();
      ASSERT_TRUE(frame) << frame.error().text();
      if (!*frame) break;
      ++frames;
      const auto refusal = gate.refusal(**frame);
      EXPECT_FALSE(refusal) << options << ", frame " << frames << ": "
                            << kFrameVerdictNames[static_cast<std::size_t>(*refusal)];
    }
    EXPECT_GT(frames, 3U);
  }
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& scene : sim::built_in_scenes()) names.emplace_back(scene.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace swiftlet
