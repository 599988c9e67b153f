// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/brute_distance.hpp"
#include "support/seeds.hpp"
#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::test {

/// What a flight with a distance field came to.
struct DistanceFlight {
  std::size_t checked = 0;  ///< voxels that were compared with a search
  std::size_t near = 0;     ///< of these, within reach of an obstacle and none themselves
  std::size_t moves = 0;    ///< of the window
};

/// Maps a source; after every frame the field must equal a search in `voxels` random voxels, for
/// both kinds of obstacles, and now and then one from scratch in all.
inline DistanceFlight check_distances(const std::string& address, const MapperConfig& config,
                                      double reach_m, int frames, int voxels) {
  DistanceFlight flight;
  Random random;
  auto source = open_source(address);
  EXPECT_TRUE(source) << source.error().text();
  if (!source) return flight;
  auto mapper = Mapper::create(config);
  const DistanceFieldOptions options{.max_distance_m = reach_m, .thresholds = config.occupancy};
  const auto make = [&] {
    return *DistanceField::create(config.map.voxel_m, mapper->map().window().size, options);
  };
  DistanceField field = make();
  BruteDistance truth(reach_m / config.map.voxel_m);
  for (int i = 0; i < frames; ++i) {
    const auto frame = (*source)->next();
    EXPECT_TRUE(frame) << frame.error().text();
    if (!frame || !*frame) break;
    flight.moves += mapper->integrate(**frame).shift.moved ? 1 : 0;
    const auto map = mapper->snapshot();
    field.update(*map);
    truth.look(*map, field.box(), config.occupancy);
    if (i % 25 == 0) {
      DistanceField fresh = make();
      fresh.update(*map);
      EXPECT_TRUE(same_bits(field, fresh)) << "frame " << i;
    }
    const VoxelBox box = voxel_box(field.box());
    for (int n = 0; n < voxels; ++n) {
      const VoxelIndex v{random.integer(box.first.x, box.last.x),
                         random.integer(box.first.y, box.last.y),
                         random.integer(box.first.z, box.last.z)};
      for (const Obstacles obstacles : kBothObstacles) {
        const auto squared = truth.squared(v, obstacles);
        flight.near += squared.value_or(0) > 0 ? 1 : 0;
        ++flight.checked;
        if (field.squared_voxels(v, obstacles) == squared) continue;
        ADD_FAILURE() << "frame " << i << ", voxel " << v.x << " " << v.y << " " << v.z << ", "
                      << random.repeat();
        return flight;
      }
    }
  }
  return flight;
}

}  // namespace swiftlet::test
