// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/random/scene_kinds.hpp"

#include <array>

// A kind of random scene is one file and one line here: its name, its function draw_<name>, and a
// sentence for `swiftlet list`.
#define SWIFTLET_SCENE_KINDS(X)                                                      \
  X(forest, "trees with bare branches, undergrowth, and wires between the trunks")   \
  X(warehouse, "rows of shelves across the hall, pallets and hanging cables")        \
  X(office, "rooms along a corridor, with doors, furniture and lamps on thin wires") \
  X(cave, "a winding cave with rubble, boulders, stalactites and props")             \
  X(maze, "a maze of corridors with pipes, posts and low walls across")

namespace swiftlet::sim {

#define SWIFTLET_DECLARE(name, summary) void draw_##name(SceneDraft& draft);
SWIFTLET_SCENE_KINDS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<DrawScene>> scene_kinds() {
#define SWIFTLET_ROW(name, summary)                                                          \
  Registered<DrawScene>{#name, summary, SWIFTLET_IF_BUILT(SWIFTLET_HAS_EMBREE, draw_##name), \
                        "EMBREE"},
  static constexpr auto kKinds = std::to_array({SWIFTLET_SCENE_KINDS(SWIFTLET_ROW)});
#undef SWIFTLET_ROW
  return kKinds;
}

}  // namespace swiftlet::sim
