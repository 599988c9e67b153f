// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/page/wire.hpp"

#include <zstd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "swiftlet/base/byte_writer.hpp"
#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet::station {
namespace {

constexpr std::uint16_t kFrameRecordBytes = 112;
constexpr std::uint16_t kClearsFirst = 1;  // flag of a blocks message
constexpr std::size_t kCourseParts = 4096;

void write_header(ByteWriter& out, MessageType type, const MessageHeader& header,
                  std::uint16_t flags = 0) {
  out.u8(static_cast<std::uint8_t>(type));
  out.u8(kWireVersion);
  out.u16(flags);
  out.u32(header.sequence);
  out.u32(header.world);
}

void write_index(ByteWriter& out, const BlockIndex& index) {
  out.i32(index.x);
  out.i32(index.y);
  out.i32(index.z);
}

void write_frame(ByteWriter& out, const FrameReport& frame) {
  out.integer(frame.stamp.ns);
  out.u32(frame.number);
  out.u8(frame.verdict);
  out.u8(static_cast<std::uint8_t>((frame.has_shifted ? 1U : 0U) |
                                   (frame.blocks_left > 0 ? 2U : 0U) |
                                   (frame.was_hidden ? 4U : 0U)));
  out.u8(frame.camera);
  out.u8(0);
  for (const double v : frame.T_world_camera.translation()) out.f64(v);
  for (const double v : frame.T_world_camera.rotation().coeffs()) out.f32(v);  // x y z w
  for (const float v : frame.stage_ms) out.f32(v);
  out.u32(frame.readings);
  out.u32(frame.voxels);
  out.u32(frame.blocks_left);
  const auto& camera = frame.intrinsics;
  out.u16(camera ? to<std::uint16_t>(camera->width()) : 0);
  out.u16(camera ? to<std::uint16_t>(camera->height()) : 0);
  out.f32(camera ? camera->fx() : 0.0);
  out.f32(camera ? camera->fy() : 0.0);
  out.f32(camera ? camera->cx() : 0.0);
  out.f32(camera ? camera->cy() : 0.0);
  std::uint32_t lost = 0;
  for (const std::uint32_t n : frame.lost) lost += n;
  out.u32(lost);
  out.u32(0);
}

void write_place(ByteWriter& out, const Eigen::Vector3d& p) {
  for (const double v : p) out.f32(v);
}

std::vector<double> list_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string hello_text(const MapInfo& info, std::uint32_t world) {
  const nlohmann::ordered_json hello{{"op", "hello"},
                                     {"protocol", kWireVersion},
                                     {"world", world},
                                     {"source", info.source},
                                     {"version", info.version},
                                     {"live", info.is_live},
                                     {"voxel_m", info.header.voxel_m},
                                     {"free_below", info.header.scale.thresholds.free_below},
                                     {"occupied_from", info.header.scale.thresholds.occupied_from},
                                     {"logodds_per_step", info.header.scale.logodds_per_step},
                                     {"trigger_m", list_of(info.trigger_m)},
                                     {"min_range_m", info.min_range_m},
                                     {"max_range_m", info.max_range_m},
                                     {"stages", info.stages},
                                     {"verdicts", info.verdicts},
                                     {"losses", info.losses}};
  // A file name may hold any byte.
  return hello.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Bytes frames_message(const MessageHeader& header, std::span<const FrameReport> reports) {
  Bytes message;
  message.reserve(16 + reports.size() * kFrameRecordBytes);
  ByteWriter out(message);
  write_header(out, MessageType::kFrames, header);
  out.u16(to<std::uint16_t>(reports.size()));
  out.u16(kFrameRecordBytes);
  for (const FrameReport& report : reports) write_frame(out, report);
  SWIFTLET_REQUIRE(message.size() == 16 + reports.size() * kFrameRecordBytes,
                   "a frame record has the length that the message states");
  return message;
}

Bytes status_message(const MessageHeader& header, const StatusReport& status) {
  Bytes message;
  ByteWriter out(message);
  write_header(out, MessageType::kStatus, header);
  out.u8(static_cast<std::uint8_t>(status.state));
  out.u8(to<std::uint8_t>(status.verdicts.size()));
  out.u8(to<std::uint8_t>(status.losses.size()));
  out.u8(0);
  write_index(out, status.window.first);
  write_index(out, status.window.size);
  for (const double v : status.trigger_centre_m) out.f64(v);
  out.u64(status.frame_count);
  out.u64(status.memory_bytes);
  out.u32(status.blocks);
  out.u32(status.pending);
  out.u32(status.clients);
  out.u32(status.rate_limit);
  out.u32(status.reports_missed);
  for (const std::uint32_t n : status.verdicts) out.u32(n);
  for (const std::uint32_t n : status.losses) out.u32(n);
  return message;
}

Bytes course_message(const MessageHeader& header, const Course& course) {
  const std::size_t points = std::min(course.path.size(), kCourseParts);
  const std::size_t pieces = std::min(course.frontier.size(), kCourseParts);
  Bytes message;
  ByteWriter out(message);
  write_header(out, MessageType::kCourse, header);
  out.u64(course.frame_count);
  out.u16(to<std::uint16_t>(points));
  out.u16(to<std::uint16_t>(pieces));
  out.u32((course.goal_m ? 1U : 0U) | (course.target_m ? 2U : 0U) | (course.looks_at_m ? 4U : 0U));
  for (const auto& place : {course.goal_m, course.target_m, course.looks_at_m})
    write_place(out, place.value_or(Eigen::Vector3d::Zero()));
  for (std::size_t i = 0; i < points; ++i) {
    write_place(out, course.path[i].p_world);
    out.f32(course.path[i].clearance_m);
  }
  for (std::size_t i = 0; i < pieces; ++i) {
    write_place(out, course.frontier[i].centroid_m);
    out.u32(course.frontier[i].voxels);
  }
  return message;
}

Bytes checksum_message(const MessageHeader& header, std::uint64_t frame_count,
                       const MapDigest& digest) {
  Bytes message;
  ByteWriter out(message);
  write_header(out, MessageType::kChecksum, header);
  out.u64(frame_count);
  out.u32(digest.blocks);
  out.u32(digest.occupied);
  out.u32(digest.free);
  out.u32(digest.hash_a);
  out.u32(digest.hash_b);
  return message;
}

void BlockPacker::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

BlockPacker::BlockPacker() : compressor_(ZSTD_createCCtx()) {
  SWIFTLET_REQUIRE(compressor_ != nullptr, "zstd needs memory for its context");
  ZSTD_CCtx_setParameter(compressor_.get(), ZSTD_c_compressionLevel, 1);
}

Bytes BlockPacker::blocks_message(const MessageHeader& header, const ClientQueue::Batch& batch,
                                  const MapMirror& mirror) {
  const BlockIndex base = batch.blocks.empty() ? BlockIndex{} : batch.blocks.front();
  std::vector<const VoxelBlock*> known;
  std::vector<BlockIndex> places;
  std::vector<BlockIndex> gone;
  for (const BlockIndex& index : batch.blocks) {
    const VoxelBlock* block = mirror.find(index);
    (block != nullptr ? places : gone).push_back(index);
    if (block != nullptr) known.push_back(block);
  }
  plain_.clear();
  ByteWriter plain(plain_);
  for (const auto* list : {&places, &gone}) {
    for (const BlockIndex& index : *list) {
      plain.integer(to<std::int16_t>(index.x - base.x));
      plain.integer(to<std::int16_t>(index.y - base.y));
      plain.integer(to<std::int16_t>(index.z - base.z));
    }
  }
  for (const VoxelBlock* block : known) plain.bytes(block->voxels);
  packed_.resize(ZSTD_compressBound(plain_.size()));
  const std::size_t size = ZSTD_compress2(compressor_.get(), packed_.data(), packed_.size(),
                                          plain_.data(), plain_.size());
  SWIFTLET_REQUIRE(!ZSTD_isError(size), "data always compresses into its bound");

  Bytes message;
  ByteWriter out(message);
  write_header(out, MessageType::kBlocks, header, batch.clears_first ? kClearsFirst : 0);
  out.u64(mirror.frame_count());
  write_index(out, base);
  out.u16(to<std::uint16_t>(known.size()));
  out.u16(to<std::uint16_t>(gone.size()));
  out.bytes({packed_.data(), size});
  return message;
}

}  // namespace swiftlet::station
