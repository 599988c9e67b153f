// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>

#include "swiftlet/station/foxglove/foxglove_messages.hpp"
#include "swiftlet/station/foxglove/foxglove_parts.hpp"

namespace swiftlet::station {

/// Centres of all occupied voxels [m, map] with their byte.
Bytes occupied_voxels(const MapModel& model) {
  constexpr std::uint32_t kStride = 13;
  Bytes points;
  points.reserve(std::size_t{kStride} * model.map().digest().occupied);
  ByteWriter point(points);
  const double voxel_m = model.map().voxel_m();
  model.map().for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const QuantizedLogOdds voxel = block.voxels[static_cast<std::size_t>(i)];
      if (model.map().scale().classify(voxel) != Occupancy::kOccupied) continue;
      for (const double v : centre_of(voxel_at(index, i), voxel_m)) point.f32(v);
      point.u8(voxel);
    }
  });
  Bytes message;
  CdrWriter out(message);
  write_time(out, model);
  out.text(kMapFrame);
  write_pose(out, Eigen::Vector3d::Zero());
  out.u32(kStride);
  constexpr std::array kFields{Field{"x", 0, kFloat32}, Field{"y", 4, kFloat32},
                               Field{"z", 8, kFloat32}, Field{"log_odds", 12, kUint8}};
  write_fields(out, kFields);
  out.bytes(points);
  return message;
}

/// The blocks around the vehicle as a dense grid, as the schema has it: z slowest, x fastest.
Bytes window_grid(const MapModel& model) {
  constexpr BlockIndex kHalf{4, 4, 2};  // blocks on either side of the vehicle's
  constexpr std::uint32_t kVoxelBytes = 5;
  const BlockIndex& centre = model.centre();
  const VoxelIndex first =
      first_voxel({centre.x - kHalf.x, centre.y - kHalf.y, centre.z - kHalf.z});
  constexpr std::int32_t kX = (2 * kHalf.x + 1) * kBlockEdge;
  constexpr std::int32_t kY = (2 * kHalf.y + 1) * kBlockEdge;
  constexpr std::int32_t kZ = (2 * kHalf.z + 1) * kBlockEdge;
  Bytes voxels;
  voxels.reserve(std::size_t{kVoxelBytes} * kX * kY * kZ);
  const auto write_voxel = [&](QuantizedLogOdds voxel) {
    voxels.push_back(voxel);
    switch (model.map().scale().classify(voxel)) {
      case Occupancy::kOccupied:
        voxels.insert(voxels.end(), {47, 111, 219, 255});
        break;
      case Occupancy::kFree:
        voxels.insert(voxels.end(), {242, 201, 76, 20});
        break;
      case Occupancy::kUnknown:
        voxels.insert(voxels.end(), {0, 0, 0, 0});
        break;
    }
  };
  for (std::int32_t z = 0; z < kZ; ++z) {
    for (std::int32_t y = 0; y < kY; ++y) {
      for (std::int32_t x = 0; x < kX; x += kBlockEdge) {
        const VoxelIndex v{first.x + x, first.y + y, first.z + z};
        const VoxelBlock* block = model.map().find(block_of(v));
        const std::size_t row = offset_in_block(v);
        for (std::size_t i = 0; i < kBlockEdge; ++i) {
          write_voxel(block == nullptr ? kUnknownVoxel : block->voxels[row + i]);
        }
      }
    }
  }
  const double voxel_m = model.map().voxel_m();
  Bytes message;
  CdrWriter out(message);
  write_time(out, model);
  out.text(kMapFrame);
  write_pose(out, Eigen::Vector3d(first.x, first.y, first.z) * voxel_m);
  out.u32(kY);
  out.u32(kX);
  write_vector(out, Eigen::Vector3d::Constant(voxel_m));
  out.u32(kVoxelBytes * kX * kY);
  out.u32(kVoxelBytes * kX);
  out.u32(kVoxelBytes);
  constexpr std::array kFields{Field{"log_odds", 0, kUint8}, Field{"red", 1, kUint8},
                               Field{"green", 2, kUint8}, Field{"blue", 3, kUint8},
                               Field{"alpha", 4, kUint8}};
  write_fields(out, kFields);
  out.bytes(voxels);
  return message;
}

}  // namespace swiftlet::station
