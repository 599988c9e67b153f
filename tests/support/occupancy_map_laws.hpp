// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <vector>

#include "support/seeds.hpp"
#include "swiftlet/map/block_map.hpp"
#include "swiftlet/query/box_query.hpp"
#include "swiftlet/query/known_voxels.hpp"
#include "swiftlet/query/map_summary.hpp"
#include "swiftlet/query/occupancy_query.hpp"
#include "swiftlet/query/ray_query.hpp"

namespace swiftlet::test {

/// What a map is to say, in the plainest form: every voxel that is not unknown by its byte.
struct MapModel {
  double voxel_m = 0.1;
  LogOddsScale scale{{90, 200}, 0.05};  // not the defaults
  std::unordered_map<VoxelIndex, QuantizedLogOdds, VoxelHash> voxels{};

  [[nodiscard]] QuantizedLogOdds at(const VoxelIndex& v) const {
    const auto found = voxels.find(v);
    return found == voxels.end() ? kUnknownVoxel : found->second;
  }
  [[nodiscard]] Occupancy state(const VoxelIndex& v) const { return scale.classify(at(v)); }
};

/// Voxels of all states, in patches, within a box.
inline MapModel random_model(Random& random, const VoxelBox& box) {
  MapModel model;
  const auto within = [&](std::int32_t a, std::int32_t b) { return random.integer(a, b); };
  for (int patch = 0; patch < 40; ++patch) {
    const VoxelIndex at{within(box.first.x, box.last.x), within(box.first.y, box.last.y),
                        within(box.first.z, box.last.z)};
    const auto voxel = static_cast<QuantizedLogOdds>(random.chance(0.8) ? random.integer(0, 100)
                                                                        : random.integer(101, 255));
    const int reach = random.integer(0, 6);
    for (VoxelIndex v{at.x - reach, 0, 0}; v.x <= at.x + reach; ++v.x) {
      for (v.y = at.y - reach; v.y <= at.y + reach; ++v.y) {
        for (v.z = at.z - reach; v.z <= at.z + reach; ++v.z) {
          if (box.contains(v)) model.voxels[v] = voxel;
        }
      }
    }
  }
  std::erase_if(model.voxels, [](const auto& voxel) { return voxel.second == kUnknownVoxel; });
  return model;
}

/// The model in memory.
inline BlockMap block_map_of(const MapModel& model) {
  BlockMap map({model.voxel_m, model.scale});
  for (const auto& [voxel, value] : model.voxels) map.set(voxel, value);
  return map;
}

/// A ray followed through the model one voxel after the other, without any box.
inline RayHit cast_in_model(const MapModel& model, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to, UnknownSpace unknown) {
  constexpr std::int32_t kFar = 100'000;
  const GridRay ray{from / model.voxel_m, to / model.voxel_m};
  const double length_m = (to - from).norm();
  GridWalk walk(ray, {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}, {});
  do {
    const Occupancy state = model.state(walk.voxel());
    if (state == Occupancy::kOccupied ||
        (state == Occupancy::kUnknown && unknown == UnknownSpace::kStops))
      return {state, walk.entered_at() * length_m, walk.voxel()};
  } while (walk.advance());
  return {Occupancy::kFree, length_m, walk.voxel()};
}

template <OccupancyMap Map>
void expect_points_and_rays_of(const MapModel& model, const Map& map, const VoxelBox& around,
                               Random& random) {
  const auto place = [&]() -> Eigen::Vector3d {
    return Eigen::Vector3d(random.real(around.first.x - 8, around.last.x + 8),
                           random.real(around.first.y - 8, around.last.y + 8),
                           random.real(around.first.z - 8, around.last.z + 8)) *
           model.voxel_m;
  };
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p_world = place();
    const VoxelIndex v = voxel_containing(p_world, model.voxel_m);
    EXPECT_EQ(map.log_odds(v), model.at(v)) << random.repeat();
    EXPECT_EQ(occupancy_at(map, p_world), model.state(v)) << random.repeat();
    EXPECT_EQ(map.occupancy(v), model.state(v)) << random.repeat();
    EXPECT_EQ(map.probability(p_world), model.scale.probability(model.at(v))) << random.repeat();
    for (const UnknownSpace unknown : {UnknownSpace::kStops, UnknownSpace::kPasses}) {
      const Eigen::Vector3d to = place();
      const RayHit hit = cast_ray(map, p_world, to, unknown);
      const RayHit expected = cast_in_model(model, p_world, to, unknown);
      EXPECT_EQ(hit.state, expected.state) << random.repeat();
      // Rounding of the place where the ray meets a face, which the two count from other faces.
      EXPECT_NEAR(hit.distance_m, expected.distance_m, 1e-9) << random.repeat();
    }
  }
}

template <OccupancyMap Map>
void expect_box_of(const MapModel& model, const Map& map, const VoxelBox& box, Random& random) {
  VoxelCounts counts;
  std::vector<QuantizedLogOdds> bytes;
  for (VoxelIndex v = box.first; v.z <= box.last.z; ++v.z) {
    for (v.y = box.first.y; v.y <= box.last.y; ++v.y) {
      for (v.x = box.first.x; v.x <= box.last.x; ++v.x) {
        bytes.push_back(model.at(v));
        counts.add(model.state(v));
      }
    }
  }
  ASSERT_EQ(bytes.size(), box.voxel_count());
  EXPECT_EQ(count_voxels(map, box), counts) << random.repeat();
  constexpr QuantizedLogOdds kUntouched = 77;
  std::vector<QuantizedLogOdds> copied(bytes.size() + 1, kUntouched);
  copy_box(map, box, std::span<QuantizedLogOdds>(copied));
  EXPECT_EQ(copied.back(), kUntouched) << "what lies behind the box stays as it is";
  copied.pop_back();
  EXPECT_EQ(copied, bytes) << random.repeat();
  std::vector<Occupancy> states(bytes.size());
  copy_box(map, box, std::span<Occupancy>(states));
  std::vector<float> probabilities(bytes.size());
  copy_box(map, box, std::span<float>(probabilities));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_EQ(states[i], model.scale.classify(bytes[i]));
    EXPECT_FLOAT_EQ(probabilities[i], static_cast<float>(model.scale.probability(bytes[i])));
  }
}

template <OccupancyMap Map>
void expect_iteration_of(const MapModel& model, const Map& map) {
  MapSummary expected;
  std::set<VoxelIndex> known;
  for (const auto& [v, voxel] : model.voxels) {
    if (model.state(v) == Occupancy::kUnknown) continue;
    known.insert(v);
    if (!expected.bounds) expected.bounds = VoxelBox{v, v};
    expected.bounds->include(v);
    expected.voxels.add(model.state(v));
  }
  for_each_known_voxel(map, [&](const VoxelIndex& v, QuantizedLogOdds voxel, Occupancy state) {
    EXPECT_EQ(known.erase(v), 1U) << "each once, and no other";
    EXPECT_EQ(voxel, model.at(v));
    EXPECT_EQ(state, model.state(v));
  });
  EXPECT_TRUE(known.empty());
  const MapSummary summary = summarize(map);
  EXPECT_EQ(summary.voxels.free, expected.voxels.free);
  EXPECT_EQ(summary.voxels.occupied, expected.voxels.occupied);
  EXPECT_EQ(count_voxels(map), summary.voxels);
  ASSERT_EQ(summary.bounds.has_value(), expected.bounds.has_value());
  if (summary.bounds) {
    EXPECT_EQ(summary.bounds->first, expected.bounds->first);
    EXPECT_EQ(summary.bounds->last, expected.bounds->last);
  }
}

/// A map of any kind answers as the model does, within a box and around it.
template <OccupancyMap Map>
void expect_answers_of(const MapModel& model, const Map& map, const VoxelBox& around,
                       Random& random) {
  EXPECT_EQ(map.voxel_m(), model.voxel_m);
  EXPECT_EQ(LogOddsScale(map.scale()), model.scale);
  expect_points_and_rays_of(model, map, around, random);
  expect_iteration_of(model, map);
  for (int i = 0; i < 20; ++i) {
    const auto edge = [&](std::int32_t first, std::int32_t last) {
      const std::int32_t a = random.integer(first - 10, last + 10);
      return std::pair(a, a + random.integer(0, 30));
    };
    const auto [x0, x1] = edge(around.first.x, around.last.x);
    const auto [y0, y1] = edge(around.first.y, around.last.y);
    const auto [z0, z1] = edge(around.first.z, around.last.z);
    expect_box_of(model, map, {{x0, y0, z0}, {x1, y1, z1}}, random);
  }
}

}  // namespace swiftlet::test
