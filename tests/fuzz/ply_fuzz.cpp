// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are a PLY mesh. What is read has corners that exist, and no more of them than bytes.

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "swiftlet/sim/ply_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  const auto mesh = swiftlet::sim::read_ply(in, "f.ply");
  if (!mesh) return 0;
  if (mesh->vertices_m.size() > size || mesh->triangles.size() > size) std::abort();
  for (const auto& triangle : mesh->triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= mesh->vertices_m.size()) std::abort();
    }
  }
  return 0;
}
