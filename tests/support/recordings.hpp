// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "support/png_writer.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::test {

inline constexpr std::string_view kIdentityPose = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
inline constexpr std::string_view kSmallCamera = "20 0 11.5\n0 20 7.5\n0 0 1\n";

/// 24 x 16 pixels, all of one value.
[[nodiscard]] inline Image<std::uint16_t> flat(std::uint16_t value) { return {24, 16, value}; }

/// One frame in the 7-Scenes layout.
inline void write_seven_scenes_frame(const std::filesystem::path& folder, int number,
                                     const Image<std::uint16_t>& depth = flat(2000),
                                     std::string_view pose = kIdentityPose) {
  write_png(folder / fmt::format("frame-{:06}.depth.png", number), depth);
  write_file(folder / fmt::format("frame-{:06}.pose.txt", number), pose);
}

/// A folder of three good frames in the 7-Scenes layout, to be spoilt by the test.
inline void write_seven_scenes(const std::filesystem::path& folder) {
  write_file(folder / "camera-intrinsics.txt", kSmallCamera);
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder, number);
}

/// What a source delivered until its end or its first error.
struct Reading {
  std::vector<Frame> frames;
  FrameTally tally;
  std::string error;  ///< empty if it was read to the end
  std::vector<RigEvent> events;
};

/// Reads a source to its end and checks the laws that hold for every source.
[[nodiscard]] inline Reading read_all(const std::string& address) {
  Reading reading;
  auto source = open_source(address);
  if (!source) {
    reading.error = source.error().text();
    return reading;
  }
  for (;;) {
    auto frame = (*source)->next();
    for (RigEvent& event : (*source)->take_events()) reading.events.push_back(std::move(event));
    if (!frame) reading.error = frame.error().text();
    if (!frame || !*frame) break;
    if (!reading.frames.empty()) {
      EXPECT_LT(reading.frames.back().stamp, (*frame)->stamp) << "stamps strictly increase";
    }
    reading.frames.push_back(std::move(**frame));
  }
  const auto after_end = (*source)->next();
  EXPECT_TRUE(after_end && !*after_end) << "after an end or an error there is nothing more";
  reading.tally = (*source)->tally();
  EXPECT_EQ(reading.tally.delivered, reading.frames.size());
  EXPECT_EQ((*source)->info().uri, address);
  return reading;
}

}  // namespace swiftlet::test
