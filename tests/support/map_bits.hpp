// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::test {

/// What tells two maps apart: a hash of every known block at its place.
struct MapBits {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  std::size_t known_voxels = 0;
  std::uint64_t frames = 0;

  void add(std::uint64_t byte) { hash = (hash ^ (byte & 0xFFU)) * 1099511628211U; }
  friend bool operator==(const MapBits&, const MapBits&) = default;
  friend std::ostream& operator<<(std::ostream& out, const MapBits& bits) {
    return out << std::hex << bits.hash << std::dec << " (" << bits.known_voxels << " voxels, "
               << bits.frames << " frames)";
  }
};

[[nodiscard]] inline MapBits bits_of(Mapper& mapper) {
  MapBits bits;
  bits.frames = mapper.frame_count();
  const auto snapshot = mapper.snapshot();
  EXPECT_TRUE(snapshot);
  if (!snapshot) return bits;
  snapshot->for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    for (const std::int32_t i : {index.x, index.y, index.z}) {
      for (int shift = 0; shift < 32; shift += 8)
        bits.add(static_cast<std::uint32_t>(i) >> static_cast<unsigned>(shift));
    }
    for (const QuantizedLogOdds voxel : block.voxels) {
      bits.add(voxel);
      bits.known_voxels += voxel == kUnknownVoxel ? 0 : 1;
    }
  });
  return bits;
}

/// Maps a source from end to end with the default configuration.
[[nodiscard]] inline MapBits map_bits(const std::string& address, MapperConfig config = {}) {
  auto mapper = Mapper::create(config);
  auto source = open_source(address);
  EXPECT_TRUE(mapper);
  EXPECT_TRUE(source) << source.error().text();
  if (!mapper || !source) return {};
  while (true) {
    const auto frame = (*source)->next();
    EXPECT_TRUE(frame) << frame.error().text();
    if (!frame || !*frame) break;
    mapper->integrate(**frame);
  }
  return bits_of(*mapper);
}

}  // namespace swiftlet::test
