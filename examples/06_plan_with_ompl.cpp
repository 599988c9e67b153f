// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: how do I plan on the map while mapping goes on, and learn that a wall is in the way?

#include <atomic>
#include <cstdio>
#include <optional>
#include <thread>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/plan/plan_path.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

const Eigen::Vector3d kHere(2.8, 3.0, 1.3), kKitchen(8.4, 1.7, 1.3);

/// The planner's thread: a path through what may be free, until a newer frame shows a wall on it.
void plan(const swiftlet::MapReader& reader, const std::atomic<bool>& is_flying) {
  const auto drone = swiftlet::BodyShape::sphere(0.25);
  swiftlet::PlanOptions options{.comfort_m = 0.2, .bounds = {{{0, 0, 0.5}, {10, 8, 2.2}}}};
  options.sweep.unknown = swiftlet::UnknownSpace::kPasses;  // what is there will be seen on the way
  std::optional<swiftlet::PlannedPath> path;
  for (bool is_last = false; !is_last;) {
    is_last = !is_flying;
    const auto map = reader.latest();  // a whole frame, held
    if (!map) continue;
    const auto frame = static_cast<int>(map->frame_count());
    if (path) {
      const auto polyline = swiftlet::SweepPath::along(path->points);
      const auto answer = swiftlet::sweep(*map, *drone, *polyline, options.sweep);
      if (answer && !answer->occupied) continue;
      std::printf("frame %d: blocked after %.2f m; ", frame, answer ? answer->clear_m : 0.0);
    }
    auto planned = swiftlet::plan_path(*map, *drone, kHere, kKitchen, options);
    if (planned) std::printf("frame %d: planned %.2f m\n", frame, planned->length_m);
    if (!planned) std::printf("frame %d: %s\n", frame, planned.error().text().c_str());
    path = planned ? std::optional(std::move(*planned)) : std::nullopt;
  }
  if (path) std::printf("the way is clear: %.2f m\n", path->length_m);
}

}  // namespace

int main() {
  auto source = swiftlet::open_source("sim:apartment?rate=1");
  swiftlet::MapperConfig config;
  config.map.voxel_m = 0.1;
  auto mapper = swiftlet::Mapper::create(config);
  if (!source || !mapper) return 2;
  std::atomic<bool> is_flying{true};
  std::thread planner(plan, mapper->reader(), std::cref(is_flying));
  for (auto frame = (*source)->next(); frame && *frame; frame = (*source)->next())
    mapper->integrate(**frame);
  is_flying = false;
  planner.join();
}
