// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are an OctoMap. It is read leaf by leaf and laid out into blocks; neither may crash,
// hang, or take more memory than OctomapBlocks::kMostBlocks.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "swiftlet/store/export/octomap_blocks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const int file = memfd_create("input.bt", 0);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  std::uint64_t leaves = 0;
  const auto summary = read_octomap(path, [&](const OctomapLeaf&) { ++leaves; });
  if (summary && (leaves != summary->leaves || leaves > 4 * size)) std::abort();
  const auto blocks = read_octomap_blocks(path, OccupancyThresholds{});
  if (blocks && (!summary || blocks->blocks.size() > OctomapBlocks::kMostBlocks)) std::abort();
  close(file);
  return 0;
}
