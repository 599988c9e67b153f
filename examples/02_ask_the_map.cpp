// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: is this point free? What is in my way? And how do I ask while mapping goes on?
// Run: example_02_ask_the_map SOURCE

#include <atomic>
#include <cstdio>
#include <thread>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/ray_query.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

constexpr const char* kNames[] = {"free", "unknown", "occupied"};

/// The planner: has its own thread and its own reader, and always sees whole frames.
void plan(const swiftlet::MapReader& reader, const std::atomic<bool>& is_flying) {
  std::uint64_t last_seen = 0;
  while (is_flying) {
    const auto map = reader.latest();
    if (!map || map->frame_count() < last_seen + 20) continue;
    last_seen = map->frame_count();
    const auto here = map->occupancy(Eigen::Vector3d(1.0, 0.0, 0.0));
    const auto ahead = swiftlet::cast_ray(*map, {0.3, 0.0, 0.0}, {5.0, 0.0, 0.0});
    std::printf("frame %llu: 1 m ahead is %s; the way is clear for %.2f m, then %s\n",
                static_cast<unsigned long long>(last_seen), kNames[static_cast<int>(here)],
                ahead.distance_m, kNames[static_cast<int>(ahead.state)]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  auto source = swiftlet::open_source(argc == 2 ? argv[1] : "");
  auto mapper = swiftlet::Mapper::create(swiftlet::MapperConfig{});
  if (!source || !mapper) {
    std::fprintf(stderr, "%s\n", (source ? mapper.error() : source.error()).text().c_str());
    return 2;
  }
  std::atomic<bool> is_flying{true};
  std::thread planner(plan, mapper->reader(), std::cref(is_flying));
  for (auto frame = (*source)->next(); frame && *frame; frame = (*source)->next())
    mapper->integrate(**frame);
  is_flying = false;
  planner.join();
}
