// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "support/temp_folder.hpp"
#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::test {

/// A furnished room of 6 x 5 x 2.6 m, and 14 s in it. The camera has few pixels, so that flights
/// take seconds, and the noise of a D435: as many times fewer as its baseline is longer.
inline constexpr std::string_view kRoom = R"(seed: 5
materials: { wall: { texture: 0.9 } }
camera: { width_px: 160, height_px: 90, rate_hz: 10, baseline_m: 0.265 }
boxes:
  - { name: floor, from_m: [-3, -2.5, -0.1], to_m: [3, 2.5, 0], material: wall }
  - { name: ceiling, from_m: [-3, -2.5, 2.6], to_m: [3, 2.5, 2.7], material: wall }
  - { name: north, from_m: [3, -2.5, 0], to_m: [3.1, 2.5, 2.6], material: wall }
  - { name: south, from_m: [-3.1, -2.5, 0], to_m: [-3, 2.5, 2.6], material: wall }
  - { name: west, from_m: [-3, 2.5, 0], to_m: [3, 2.6, 2.6], material: wall }
  - { name: east, from_m: [-3, -2.6, 0], to_m: [3, -2.5, 2.6], material: wall }
  - { name: table, from_m: [1.2, 0.8, 0.6], to_m: [2.2, 1.8, 0.75], material: wall }
  - { name: shelf, from_m: [-2.9, -2.4, 0], to_m: [-2.4, -0.8, 1.9], material: wall }
  - { name: crate, centre_m: [1.8, -1.2, 0.4], size_m: [0.7, 0.7, 0.8], yaw_deg: 25, material: wall }
flight:
  sway: { position_m: 0.02, angle_deg: 2, period_s: 2.4 }
  waypoints:
    - { at_m: [-1.2, 0.6, 1.2], yaw_deg: 0, pitch_deg: 5 }
    - { at_m: [0.2, 0.6, 1.3], yaw_deg: 0, pitch_deg: 5, leg_s: 3 }
    - { at_m: [0.2, 0.0, 1.3], yaw_deg: -90, leg_s: 3 }
    - { at_m: [-0.6, -0.2, 1.2], yaw_deg: -180, leg_s: 4 }
    - { at_m: [-0.8, 0.4, 1.2], yaw_deg: -300, leg_s: 4 }
)";

/// One flight through the room, mapped in 10 cm voxels.
struct Flown {
  Mapper mapper;
  FrameTally tally;
  std::uint32_t epochs = 0;
};

inline Flown fly_room(const std::string& options, std::string_view room = kRoom) {
  const TempFolder folder;
  write_file(folder / "room.yaml", room);
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.depth.downsample = 2;
  auto source = open_source("sim:" + (folder / "room.yaml").string() + options);
  EXPECT_TRUE(source) << source.error().text();
  if (source) config.sensor.baseline_m = (*source)->info().baseline_m.value();
  Flown flown{*Mapper::create(config), {}, 0};
  while (source) {
    const auto frame = (*source)->next();
    EXPECT_TRUE(frame) << frame.error().text();
    if (!frame || !*frame) break;
    if ((*frame)->pose_epoch != flown.epochs) {  // as MappingSession does
      flown.mapper = *Mapper::create(config);
      flown.epochs = (*frame)->pose_epoch;
    }
    flown.mapper.integrate(**frame);
  }
  if (source) flown.tally = (*source)->tally();
  return flown;
}

/// How a map of the room compares with that of a flight without any fault or noise.
struct Score {
  std::size_t known = 0;     ///< voxels that are free or occupied in both
  std::size_t same = 0;      ///< of these, in the same class
  std::size_t coverage = 0;  ///< voxels that are free or occupied in the map

  [[nodiscard]] double accuracy() const {
    return known == 0 ? 0.0 : static_cast<double>(same) / static_cast<double>(known);
  }
};

inline Score score_of(const Mapper& map, const Mapper& truth) {
  Score score;
  const auto& classes = map.config().occupancy;
  for (std::int32_t z = -2; z < 29; ++z) {
    for (std::int32_t y = -27; y < 27; ++y) {
      for (std::int32_t x = -32; x < 32; ++x) {
        const Occupancy seen = classes.classify(map.map().log_odds({x, y, z}));
        const Occupancy there = classes.classify(truth.map().log_odds({x, y, z}));
        if (seen == Occupancy::kUnknown) continue;
        ++score.coverage;
        if (there == Occupancy::kUnknown) continue;
        ++score.known;
        score.same += seen == there ? 1 : 0;
      }
    }
  }
  return score;
}

}  // namespace swiftlet::test
