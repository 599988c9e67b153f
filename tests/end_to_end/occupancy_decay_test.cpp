// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// A person crosses a hall twice and leaves. The walls are out of range, so there is no background:
// what remains of him must become unknown within integrate.decay_s, and never free.

#include <gtest/gtest.h>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

constexpr double kDecay_s = 1.0;
/// By then he is out of view; the flight goes on.
constexpr double kHasLeft_s = 15.5;

struct Hall {
  std::size_t while_there = 0;  ///< occupied voxels of the air that he crosses, at most
  std::size_t after = 0;        ///< one decay_s and a frame after he has left
};

/// The air between 0.3 and 1.7 m above the floor that he crosses in view; nothing else is in it.
std::size_t occupied_air(const Mapper& mapper) {
  const double c = mapper.map().voxel_m();
  const VoxelIndex first = voxel_containing({2.0, -1.2, 0.35}, c);
  const VoxelIndex last = voxel_containing({3.4, 1.2, 1.65}, c);
  std::size_t count = 0;
  for (VoxelIndex v = first; v.z <= last.z; ++v.z) {
    for (v.y = first.y; v.y <= last.y; ++v.y) {
      for (v.x = first.x; v.x <= last.x; ++v.x) {
        const QuantizedLogOdds voxel = mapper.map().log_odds(v);
        count += mapper.config().occupancy.classify(voxel) == Occupancy::kOccupied ? 1 : 0;
      }
    }
  }
  return count;
}

Hall fly(double decay_s, const char* model) {
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.depth.max_range_m = 4.0;
  config.integrate.decay_s = decay_s;
  config.integrate.model = model;
  auto mapper = Mapper::create(config).value();
  auto source = open_source("sim:walker?rate=15").value();
  Hall hall;
  for (;;) {
    const auto frame = source->next().value();
    if (!frame) break;
    mapper.integrate(*frame);
    const double now_s = 1e-9 * static_cast<double>(frame->stamp.ns);
    if (now_s < kHasLeft_s) hall.while_there = std::max(hall.while_there, occupied_air(mapper));
    if (now_s > kHasLeft_s + kDecay_s + 0.07) {
      hall.after = occupied_air(mapper);
      break;
    }
  }
  return hall;
}

TEST(Walker, without_background_is_unknown_within_the_time_that_is_set) {
  for (const char* model : {"inverse_sensor_model", "precision_weighted"}) {
    const Hall kept = fly(0.0, model), decayed = fly(kDecay_s, model);
    EXPECT_GT(kept.after, 500U) << model << ": else there is nothing to decay";
    EXPECT_GT(decayed.while_there, 50U) << model << ": he is seen";
    EXPECT_EQ(decayed.after, 0U) << model;
  }
}

}  // namespace
}  // namespace swiftlet
