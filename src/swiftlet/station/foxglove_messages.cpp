// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/foxglove_messages.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "swiftlet/station/cdr_writer.hpp"

namespace swiftlet::station {
namespace {

constexpr std::string_view kMapFrame = "map";
constexpr std::string_view kCameraFrame = "camera";
constexpr std::uint8_t kUint8 = 1;  // of PackedElementField
constexpr std::uint8_t kFloat32 = 7;

struct Field {
  std::string_view name;
  std::uint32_t offset;
  std::uint8_t type;
};

void write_time(CdrWriter& out, const MapWatch& watch) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  const std::int64_t ns = watch.last_frame() ? watch.last_frame()->stamp.ns : 0;
  out.i32(static_cast<std::int32_t>(ns / kNanosecondsPerSecond));
  out.u32(static_cast<std::uint32_t>(ns % kNanosecondsPerSecond));
}
void write_vector(CdrWriter& out, const Eigen::Vector3d& v) {
  for (const double value : v) out.f64(value);
}
void write_pose(CdrWriter& out, const Eigen::Vector3d& p,
                const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  write_vector(out, p);
  for (const double value : q.coeffs()) out.f64(value);  // x y z w
}
void write_color(CdrWriter& out, std::array<double, 4> rgba) {
  for (const double value : rgba) out.f64(value);
}
void write_fields(CdrWriter& out, std::span<const Field> fields) {
  out.count(fields.size());
  for (const Field& field : fields) {
    out.text(field.name);
    out.u32(field.offset);
    out.u8(field.type);
  }
}

/// Centres of all occupied cells [m, map] with their byte.
Bytes occupied_cells(const MapWatch& watch) {
  constexpr std::uint32_t kStride = 13;
  Bytes points;
  points.reserve(std::size_t{kStride} * watch.map().digest().occupied);
  ByteWriter point(points);
  const double voxel_m = watch.facts().voxel_m;
  watch.map().for_each_block([&](const BlockIndex& index, const VoxelBlock& block) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const LogOdds cell = block.cells[static_cast<std::size_t>(i)];
      if (watch.facts().thresholds.classify(cell) != Occupancy::kOccupied) continue;
      for (const double v : centre_of(voxel_at(index, i), voxel_m)) point.f32(v);
      point.u8(cell);
    }
  });
  Bytes message;
  CdrWriter out(message);
  write_time(out, watch);
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
Bytes window_grid(const MapWatch& watch) {
  constexpr BlockIndex kHalf{4, 4, 2};  // blocks on either side of the vehicle's
  constexpr std::uint32_t kCellBytes = 5;
  const BlockIndex& centre = watch.centre();
  const VoxelIndex first =
      first_voxel({centre.x - kHalf.x, centre.y - kHalf.y, centre.z - kHalf.z});
  constexpr std::int32_t kX = (2 * kHalf.x + 1) * kBlockEdge;
  constexpr std::int32_t kY = (2 * kHalf.y + 1) * kBlockEdge;
  constexpr std::int32_t kZ = (2 * kHalf.z + 1) * kBlockEdge;
  Bytes cells;
  cells.reserve(std::size_t{kCellBytes} * kX * kY * kZ);
  const auto write_cell = [&](LogOdds cell) {
    cells.push_back(cell);
    switch (watch.facts().thresholds.classify(cell)) {
      case Occupancy::kOccupied:
        cells.insert(cells.end(), {47, 111, 219, 255});
        break;
      case Occupancy::kFree:
        cells.insert(cells.end(), {242, 201, 76, 20});
        break;
      case Occupancy::kUnknown:
        cells.insert(cells.end(), {0, 0, 0, 0});
        break;
    }
  };
  for (std::int32_t z = 0; z < kZ; ++z) {
    for (std::int32_t y = 0; y < kY; ++y) {
      for (std::int32_t x = 0; x < kX; x += kBlockEdge) {
        const VoxelIndex v{first.x + x, first.y + y, first.z + z};
        const VoxelBlock* block = watch.map().find(block_of(v));
        const std::size_t row = offset_in_block(v);
        for (std::size_t i = 0; i < kBlockEdge; ++i) {
          write_cell(block == nullptr ? kUnknownCell : block->cells[row + i]);
        }
      }
    }
  }
  const double voxel_m = watch.facts().voxel_m;
  Bytes message;
  CdrWriter out(message);
  write_time(out, watch);
  out.text(kMapFrame);
  write_pose(out, Eigen::Vector3d(first.x, first.y, first.z) * voxel_m);
  out.u32(kY);
  out.u32(kX);
  write_vector(out, Eigen::Vector3d::Constant(voxel_m));
  out.u32(kCellBytes * kX * kY);
  out.u32(kCellBytes * kX);
  out.u32(kCellBytes);
  constexpr std::array kFields{Field{"log_odds", 0, kUint8}, Field{"red", 1, kUint8},
                               Field{"green", 2, kUint8}, Field{"blue", 3, kUint8},
                               Field{"alpha", 4, kUint8}};
  write_fields(out, kFields);
  out.bytes(cells);
  return message;
}

/// The vehicle with its field of view to 1 m, and the window.
Bytes vehicle(const MapWatch& watch) {
  if (!watch.last_frame()) return {};
  const FrameReport& frame = *watch.last_frame();
  Bytes message;
  CdrWriter out(message);
  out.count(0);  // deletions
  out.count(1);
  write_time(out, watch);
  out.text(kMapFrame);
  out.text("vehicle");
  out.i32(0);  // lifetime: until it is replaced
  out.u32(0);
  out.u8(0);     // not locked to the frame
  out.count(0);  // metadata
  out.count(0);  // arrows
  out.count(2);  // cubes
  const auto& T_world_camera = frame.T_world_camera;
  write_pose(out, T_world_camera.translation(), T_world_camera.rotation());
  write_vector(out, {0.3, 0.08, 0.3});
  write_color(out, {1.0, 0.48, 0.27, 1.0});
  const VoxelBox box = voxel_box(watch.map().window());
  const double voxel_m = watch.facts().voxel_m;
  const Eigen::Vector3d low = Eigen::Vector3d(box.first.x, box.first.y, box.first.z) * voxel_m;
  const Eigen::Vector3d high =
      Eigen::Vector3d(box.last.x + 1, box.last.y + 1, box.last.z + 1) * voxel_m;
  write_pose(out, 0.5 * (low + high));
  write_vector(out, high - low);
  write_color(out, {0.35, 0.66, 0.9, 0.05});
  out.count(0);  // spheres
  out.count(0);  // cylinders
  out.count(frame.intrinsics ? 1 : 0);
  if (frame.intrinsics) {
    constexpr std::uint8_t kLineList = 2;
    out.u8(kLineList);
    write_pose(out, T_world_camera.translation(), T_world_camera.rotation());
    out.f64(2.0);  // [px]
    out.u8(1);     // whatever the scale
    const double u = frame.intrinsics->width() - 1;
    const double v = frame.intrinsics->height() - 1;
    const std::array<Eigen::Vector3d, 5> corners{
        Eigen::Vector3d::Zero(), frame.intrinsics->back_project(0, 0, 1.0),
        frame.intrinsics->back_project(u, 0, 1.0), frame.intrinsics->back_project(u, v, 1.0),
        frame.intrinsics->back_project(0, v, 1.0)};
    out.count(corners.size());
    for (const auto& corner : corners) write_vector(out, corner);
    write_color(out, {1.0, 0.48, 0.27, 1.0});
    out.count(0);  // colours of their own
    constexpr std::array<std::uint32_t, 16> kEdges{0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1};
    out.count(kEdges.size());
    for (const std::uint32_t i : kEdges) out.u32(i);
  }
  out.count(0);  // triangles
  out.count(0);  // texts
  out.count(0);  // models
  return message;
}

Bytes transforms(const MapWatch& watch) {
  if (!watch.last_frame()) return {};
  const auto& T_world_camera = watch.last_frame()->T_world_camera;
  Bytes message;
  CdrWriter out(message);
  out.count(1);
  write_time(out, watch);
  out.text(kMapFrame);
  out.text(kCameraFrame);
  write_pose(out, T_world_camera.translation(), T_world_camera.rotation());
  return message;
}

Bytes calibration(const MapWatch& watch) {
  if (!watch.last_frame() || !watch.last_frame()->intrinsics) return {};
  const PinholeIntrinsics& camera = *watch.last_frame()->intrinsics;
  Bytes message;
  CdrWriter out(message);
  write_time(out, watch);
  out.text(kCameraFrame);
  out.u32(static_cast<std::uint32_t>(camera.width()));
  out.u32(static_cast<std::uint32_t>(camera.height()));
  out.text("plumb_bob");
  out.count(5);
  for (int i = 0; i < 5; ++i) out.f64(0.0);  // rectified
  const std::array k{camera.fx(), 0.0, camera.cx(), 0.0, camera.fy(), camera.cy(), 0.0, 0.0, 1.0};
  for (const double v : k) out.f64(v);
  for (const double v : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) out.f64(v);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) out.f64(k[3 * row + column]);
    out.f64(0.0);
  }
  return message;
}

Bytes depth_image(const MapWatch& watch) {
  const auto& raw = watch.depth().raw;
  if (raw.empty()) return {};
  Bytes pixels;
  pixels.reserve(2 * raw.pixels().size());
  ByteWriter pixel(pixels);
  // 16UC1 is in millimetres.
  const float scale = watch.depth().unit_m * 1000.0F;
  for (const std::uint16_t d : raw.pixels()) {
    pixel.u16(static_cast<std::uint16_t>(std::min(65535.0F, static_cast<float>(d) * scale + 0.5F)));
  }
  Bytes message;
  CdrWriter out(message);
  write_time(out, watch);
  out.text(kCameraFrame);
  out.u32(static_cast<std::uint32_t>(raw.width()));
  out.u32(static_cast<std::uint32_t>(raw.height()));
  out.text("16UC1");
  out.u32(2 * static_cast<std::uint32_t>(raw.width()));
  out.bytes(pixels);
  return message;
}

Bytes statistics(const MapWatch& watch) {
  const StatusReport status = watch.status();
  const MapDigest& digest = watch.map().digest();
  nlohmann::ordered_json json{{"frame_count", status.frame_count},
                              {"memory_bytes", status.memory_bytes},
                              {"blocks", digest.blocks},
                              {"occupied", digest.occupied},
                              {"free", digest.free}};
  for (std::size_t i = 0; i < status.verdicts.size(); ++i) {
    json["verdicts"][watch.facts().verdicts[i]] = status.verdicts[i];
  }
  for (std::size_t i = 0; i < status.losses.size(); ++i) {
    json["lost"][watch.facts().losses[i]] = status.losses[i];
  }
  if (const auto& frame = watch.last_frame()) {
    const auto& names = watch.facts().stages;
    for (std::size_t i = 0; i < std::min(names.size(), frame->stage_ms.size()); ++i) {
      json["stage_ms"][names[i]] = frame->stage_ms[i];
    }
    json["readings"] = frame->readings;
    json["cells"] = frame->cells;
    json["blocks_left"] = frame->blocks_left;
  }
  const std::string text = json.dump();
  return Bytes(text.begin(), text.end());
}

}  // namespace

std::span<const FoxgloveChannel> foxglove_channels() {
  using Follows = FoxgloveChannel::Follows;
  static constexpr std::array kChannels{
      FoxgloveChannel{"/map/occupied", "foxglove_msgs/PointCloud", Follows::kMap, 2.0,
                      occupied_cells},
      FoxgloveChannel{"/map/window", "foxglove_msgs/VoxelGrid", Follows::kMap, 1.0, window_grid},
      FoxgloveChannel{"/vehicle", "foxglove_msgs/SceneUpdate", Follows::kFrames, 20.0, vehicle},
      FoxgloveChannel{"/tf", "foxglove_msgs/FrameTransforms", Follows::kFrames, 20.0, transforms},
      FoxgloveChannel{"/camera/calibration", "foxglove_msgs/CameraCalibration", Follows::kFrames,
                      1.0, calibration},
      FoxgloveChannel{"/camera/depth", "foxglove_msgs/RawImage", Follows::kDepth, 5.0, depth_image},
      FoxgloveChannel{"/statistics", "", Follows::kFrames, 5.0, statistics},
  };
  return kChannels;
}

}  // namespace swiftlet::station
