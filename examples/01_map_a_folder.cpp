// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: how do I turn a recording into a map? (`swiftlet map` also saves it to a file.)
// Run: example_01_map_a_folder 7scenes:FOLDER   (or tum:FOLDER, or sim:apartment)

#include <cstdio>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/voxel_counts.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

swiftlet::Status map_recording(const char* address) {
  auto source = swiftlet::open_source(address);
  if (!source) return swiftlet::forward_error(std::move(source));

  swiftlet::MapperConfig config;
  config.map.voxel_m = 0.1;
  auto mapper = swiftlet::Mapper::create(config);
  if (!mapper) return swiftlet::forward_error(std::move(mapper));

  for (;;) {
    const auto frame = (*source)->next();
    if (!frame) return tl::make_unexpected(frame.error());
    if (!*frame) break;  // the end
    mapper->integrate(**frame);
  }

  const auto map = mapper->snapshot();
  const auto voxels = swiftlet::count_voxels(*map);
  std::printf("%llu frames: %zu free voxels, %zu occupied\n",
              static_cast<unsigned long long>(mapper->frame_count()), voxels.free, voxels.occupied);
  return swiftlet::Done{};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s SOURCE, as in 7scenes:FOLDER or sim:apartment\n", argv[0]);
    return 2;
  }
  const auto status = map_recording(argv[1]);
  if (status) return 0;
  std::fprintf(stderr, "%s\n", status.error().text().c_str());
  return 1;
}
