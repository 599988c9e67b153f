// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "swiftlet/bag/messages/cdr_writer.hpp"
#include "swiftlet/station/map_model.hpp"

namespace swiftlet::station {

// What messages of several channels have in common.

inline constexpr std::string_view kMapFrame = "map";
inline constexpr std::string_view kCameraFrame = "camera";
inline constexpr std::uint8_t kUint8 = 1;  // of PackedElementField
inline constexpr std::uint8_t kFloat32 = 7;

struct Field {
  std::string_view name;
  std::uint32_t offset;
  std::uint8_t type;
};

/// The last frame's stamp.
inline void write_time(CdrWriter& out, const MapModel& model) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  const std::int64_t ns = model.last_frame() ? model.last_frame()->stamp.ns : 0;
  out.i32(static_cast<std::int32_t>(ns / kNanosecondsPerSecond));
  out.u32(static_cast<std::uint32_t>(ns % kNanosecondsPerSecond));
}
inline void write_vector(CdrWriter& out, const Eigen::Vector3d& v) {
  for (const double value : v) out.f64(value);
}
inline void write_pose(CdrWriter& out, const Eigen::Vector3d& p,
                       const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  write_vector(out, p);
  for (const double value : q.coeffs()) out.f64(value);  // x y z w
}
inline void write_color(CdrWriter& out, std::array<double, 4> rgba) {
  for (const double value : rgba) out.f64(value);
}
inline void write_fields(CdrWriter& out, std::span<const Field> fields) {
  out.count(fields.size());
  for (const Field& field : fields) {
    out.text(field.name);
    out.u32(field.offset);
    out.u8(field.type);
  }
}

[[nodiscard]] Bytes occupied_voxels(const MapModel& model);
[[nodiscard]] Bytes window_grid(const MapModel& model);

}  // namespace swiftlet::station
