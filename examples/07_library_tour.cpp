// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: what does the library do for me, from a config file to a score?
// Run: example_07_library_tour CONFIG.yaml SOURCE OUT   (writes OUT.swl and OUT.png)

#include <cstdio>
#include <cstdlib>

#include "swiftlet/swiftlet.hpp"

using namespace swiftlet;

template <class Value, class Fault>  // the value, or the end of the program
Value value_of(tl::expected<Value, Fault> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "%s\n", text_of(result.error()).c_str());
  std::exit(1);
}

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: CONFIG.yaml SOURCE OUT\n"), 2;
  const std::string address = argv[2], out = argv[3];
  const LoadedConfig config = value_of(load_config({{argv[1]}, {}}));
  const FrameSourcePtr source = value_of(open_source(address));
  const auto flown = value_of(map_into_file(*source, config, {out + ".swl", {.overwrite = true}}));

  const BlockMap map = value_of(read_whole_map(out + ".swl"));
  const Eigen::Vector3d at = map.header().start_m.value(), reach(5.0, 0.0, 0.0), half(1, 1, 0.5);
  const RayHit ahead = cast_ray(map, at, at + reach, UnknownSpace::kPasses);
  const VoxelBox box = voxel_box_between(at - half, at + half, map.voxel_m());
  std::vector<float> probabilities(box.voxel_count());
  copy_box(map, box, std::span(probabilities));
  std::printf("%zu frames; p = %.2f at the start; clear for %.2f m; %zu of %zu voxels free\n",
              flown.integrated(), map.probability(at), ahead.distance_m,
              count_voxels(map, box).free, probabilities.size());

  value_of(render::write_png(value_of(render::draw_projection("top", map, {})), out + ".png"));
  const auto report =
      value_of(eval::score_source({address, config.mapper, {"precision_weighted"}, 40}));
  for (const eval::ScoreRow& row : report.rows)
    std::printf("%s: %.3f\n", row.meaning.name.c_str(), row.values[0].value_or(0.0));
}
