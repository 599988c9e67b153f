// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>
#include <zstd.h>

#include <cstring>
#include <map>
#include <optional>
#include <vector>

#include "swiftlet/station/page/wire.hpp"

namespace swiftlet::station {

/// A client as docs/formats/station_wire.md describes it, written anew: reads messages into a map.
class WireReader {
 public:
  std::map<BlockIndex, VoxelBlock> blocks;
  std::vector<std::uint32_t> frame_numbers;
  std::optional<MapDigest> checksum;
  std::uint32_t next_sequence = 0;
  std::uint32_t pending = 0;
  std::size_t bytes = 0;

  template <class T>
  static T at(const Bytes& message, std::size_t offset) {
    T value{};
    EXPECT_LE(offset + sizeof(T), message.size());
    if (offset + sizeof(T) <= message.size())
      std::memcpy(&value, message.data() + offset, sizeof(T));
    return value;
  }

  void read(const Bytes& message) {
    bytes += message.size();
    EXPECT_EQ(message.at(1), kWireVersion);
    next_sequence = at<std::uint32_t>(message, 4) + 1;
    switch (static_cast<MessageType>(message.at(0))) {
      case MessageType::kBlocks:
        return read_blocks(message);
      case MessageType::kFrames:
        for (int i = 0; i < at<std::uint16_t>(message, 12); ++i) {
          const std::size_t record = 16 + i * at<std::uint16_t>(message, 14);
          frame_numbers.push_back(at<std::uint32_t>(message, record + 8));
        }
        return;
      case MessageType::kStatus:
        pending = at<std::uint32_t>(message, 84);
        return;
      case MessageType::kCourse:
        return;
      case MessageType::kChecksum:
        checksum = MapDigest{at<std::uint32_t>(message, 20), at<std::uint32_t>(message, 24),
                             at<std::uint32_t>(message, 28), at<std::uint32_t>(message, 32),
                             at<std::uint32_t>(message, 36)};
        return;
    }
    ADD_FAILURE() << "a message of unknown type " << int{message[0]};
  }

  /// What the map here is, counted from the beginning.
  [[nodiscard]] MapDigest digest(const OccupancyThresholds& thresholds) const {
    MapDigest sum;
    for (const auto& [index, block] : blocks) {
      ++sum.blocks;
      sum.hash_a += block_hash(index, block, 0);
      sum.hash_b += block_hash(index, block, 1);
      for (const QuantizedLogOdds voxel : block.voxels) {
        sum.occupied += thresholds.classify(voxel) == Occupancy::kOccupied ? 1 : 0;
        sum.free += thresholds.classify(voxel) == Occupancy::kFree ? 1 : 0;
      }
    }
    return sum;
  }

 private:
  void read_blocks(const Bytes& message) {
    if ((at<std::uint16_t>(message, 2) & 1U) != 0) blocks.clear();
    const std::size_t known = at<std::uint16_t>(message, 32);
    const std::size_t count = known + at<std::uint16_t>(message, 34);
    Bytes plain(6 * count + kBlockVoxels * known);
    ASSERT_EQ(ZSTD_decompress(plain.data(), plain.size(), message.data() + 36, message.size() - 36),
              plain.size());
    for (std::size_t i = 0; i < count; ++i) {
      const BlockIndex index{at<std::int32_t>(message, 20) + at<std::int16_t>(plain, 6 * i),
                             at<std::int32_t>(message, 24) + at<std::int16_t>(plain, 6 * i + 2),
                             at<std::int32_t>(message, 28) + at<std::int16_t>(plain, 6 * i + 4)};
      if (i < known) {
        std::memcpy(blocks[index].voxels.data(), plain.data() + 6 * count + kBlockVoxels * i,
                    kBlockVoxels);
      } else {
        blocks.erase(index);
      }
    }
  }
};

}  // namespace swiftlet::station
