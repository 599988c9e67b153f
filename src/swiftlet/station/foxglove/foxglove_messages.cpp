// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/foxglove/foxglove_messages.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "swiftlet/station/foxglove/foxglove_parts.hpp"

namespace swiftlet::station {
namespace {

/// The vehicle with its field of view to 1 m, and the window.
Bytes vehicle(const MapModel& model) {
  if (!model.last_frame()) return {};
  const FrameReport& frame = *model.last_frame();
  Bytes message;
  CdrWriter out(message);
  out.count(0);  // deletions
  out.count(1);
  write_time(out, model);
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
  const VoxelBox box = voxel_box(model.map().window());
  const double voxel_m = model.map().voxel_m();
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

Bytes transforms(const MapModel& model) {
  if (!model.last_frame()) return {};
  const auto& T_world_camera = model.last_frame()->T_world_camera;
  Bytes message;
  CdrWriter out(message);
  out.count(1);
  write_time(out, model);
  out.text(kMapFrame);
  out.text(kCameraFrame);
  write_pose(out, T_world_camera.translation(), T_world_camera.rotation());
  return message;
}

Bytes calibration(const MapModel& model) {
  if (!model.last_frame() || !model.last_frame()->intrinsics) return {};
  const PinholeIntrinsics& camera = *model.last_frame()->intrinsics;
  Bytes message;
  CdrWriter out(message);
  write_time(out, model);
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

Bytes depth_image(const MapModel& model) {
  const auto& raw = model.depth().raw;
  if (raw.empty()) return {};
  Bytes pixels;
  pixels.reserve(2 * raw.pixels().size());
  ByteWriter pixel(pixels);
  // 16UC1 is in millimetres.
  const float scale = model.depth().unit_m * 1000.0F;
  for (const std::uint16_t d : raw.pixels()) {
    pixel.u16(static_cast<std::uint16_t>(std::min(65535.0F, static_cast<float>(d) * scale + 0.5F)));
  }
  Bytes message;
  CdrWriter out(message);
  write_time(out, model);
  out.text(kCameraFrame);
  out.u32(static_cast<std::uint32_t>(raw.width()));
  out.u32(static_cast<std::uint32_t>(raw.height()));
  out.text("16UC1");
  out.u32(2 * static_cast<std::uint32_t>(raw.width()));
  out.bytes(pixels);
  return message;
}

Bytes statistics(const MapModel& model) {
  const StatusReport status = model.status();
  const MapDigest& digest = model.map().digest();
  nlohmann::ordered_json json{{"frame_count", status.frame_count},
                              {"memory_bytes", status.memory_bytes},
                              {"blocks", digest.blocks},
                              {"occupied", digest.occupied},
                              {"free", digest.free}};
  for (std::size_t i = 0; i < status.verdicts.size(); ++i) {
    json["verdicts"][model.info().verdicts[i]] = status.verdicts[i];
  }
  for (std::size_t i = 0; i < status.losses.size(); ++i) {
    json["lost"][model.info().losses[i]] = status.losses[i];
  }
  if (const auto& frame = model.last_frame()) {
    const auto& names = model.info().stages;
    for (std::size_t i = 0; i < std::min(names.size(), frame->stage_ms.size()); ++i) {
      json["stage_ms"][names[i]] = frame->stage_ms[i];
    }
    json["readings"] = frame->readings;
    json["voxels"] = frame->voxels;
    json["blocks_left"] = frame->blocks_left;
  }
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return Bytes(text.begin(), text.end());
}

}  // namespace

std::span<const FoxgloveChannel> foxglove_channels() {
  using Follows = FoxgloveChannel::Follows;
  static constexpr std::array kChannels{
      FoxgloveChannel{"/map/occupied", "foxglove_msgs/PointCloud", Follows::kMap, 2.0,
                      occupied_voxels},
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
