// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/messages/ros2_messages.hpp"

#include "swiftlet/bag/messages/cdr_writer.hpp"
#include "swiftlet/base/byte_writer.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet::ros2 {
namespace {

constexpr std::uint8_t kUint8 = 2;  // of sensor_msgs/PointField
constexpr std::uint8_t kFloat32 = 7, kFloat64 = 8;
constexpr int kCovariance = 36, kTwist = 6;

void write(CdrWriter& out, const Header& header) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  const std::int64_t ns = header.stamp.ns;
  out.i32(static_cast<std::int32_t>(ns / kNanosecondsPerSecond));
  out.u32(static_cast<std::uint32_t>(ns % kNanosecondsPerSecond));
  out.text(header.frame_id);
}

void write(CdrWriter& out, const Placement& placement) {
  for (const double v : placement.t_m) out.f64(v);
  for (const double v : placement.R.coeffs()) out.f64(v);  // x y z w
}

void write_zeros(CdrWriter& out, int count) {
  for (int i = 0; i < count; ++i) out.f64(0.0);
}

template <class Pixel, class Write>
Bytes image(const Header& header, std::uint32_t width, std::uint32_t height,
            std::string_view encoding, std::span<const Pixel> pixels, Write&& write_pixel) {
  Bytes data;
  data.reserve(pixels.size_bytes());
  ByteWriter writer(data);
  for (const Pixel pixel : pixels) write_pixel(writer, pixel);
  Bytes message;
  message.reserve(data.size() + 128);
  CdrWriter out(message);
  write(out, header);
  out.u32(height);
  out.u32(width);
  out.text(encoding);
  out.u8(0);  // little endian
  out.u32(width * to<std::uint32_t>(sizeof(Pixel)));
  out.bytes(data);
  return message;
}

}  // namespace

Bytes depth_image(const Header& header, std::uint32_t width, std::uint32_t height,
                  std::span<const std::uint16_t> depth_mm) {
  return image(header, width, height, "16UC1", depth_mm,
               [](ByteWriter& out, std::uint16_t mm) { out.u16(mm); });
}

Bytes depth_image(const Header& header, std::uint32_t width, std::uint32_t height,
                  std::span<const float> depth_m) {
  return image(header, width, height, "32FC1", depth_m,
               [](ByteWriter& out, float m) { out.f32(double{m}); });
}

Bytes camera_info(const Header& header, std::uint32_t width, std::uint32_t height, double fx,
                  double fy, double cx, double cy) {
  Bytes message;
  CdrWriter out(message);
  write(out, header);
  out.u32(height);
  out.u32(width);
  out.text("plumb_bob");
  out.count(5);
  write_zeros(out, 5);
  for (const double k : {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}) out.f64(k);
  for (const double r : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) out.f64(r);
  for (const double p : {fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}) out.f64(p);
  for (int i = 0; i < 6; ++i) out.u32(0);  // the whole sensor, pixel by pixel
  out.u8(0);
  return message;
}

Bytes transform(const Header& header, std::string_view child, const Placement& placement) {
  Bytes message;
  CdrWriter out(message);
  out.count(1);
  write(out, header);
  out.text(child);
  write(out, placement);
  return message;
}

Bytes odometry(const Header& header, std::string_view child, const Placement& placement) {
  Bytes message;
  CdrWriter out(message);
  write(out, header);
  out.text(child);
  write(out, placement);
  write_zeros(out, kCovariance + kTwist + kCovariance);
  return message;
}

Bytes path(const Header& header, std::span<const Placement> poses) {
  Bytes message;
  CdrWriter out(message);
  write(out, header);
  out.count(poses.size());
  for (const Placement& pose : poses) {
    write(out, header);
    write(out, pose);
  }
  return message;
}

void VoxelCloud::add(const Eigen::Vector3d& p, std::uint8_t value) {
  ByteWriter point(points_);
  for (const double v : p) is_double_ ? point.f64(v) : point.f32(v);
  point.u8(value);
}

Bytes VoxelCloud::message(const Header& header) const {
  const std::uint32_t number = number_bytes(), step = 3 * number + 1;
  Bytes message;
  message.reserve(points_.size() + 256);
  CdrWriter out(message);
  write(out, header);
  out.u32(1);
  out.count(points_.size() / step);
  out.count(4);
  const auto field = [&](std::string_view name, std::uint32_t offset, std::uint8_t type) {
    out.text(name);
    out.u32(offset);
    out.u8(type);
    out.u32(1);
  };
  for (std::uint32_t i = 0; i < 3; ++i)
    field(std::string_view("xyz").substr(i, 1), i * number, is_double_ ? kFloat64 : kFloat32);
  field(value_name_, 3 * number, kUint8);
  out.u8(0);  // little endian
  out.u32(step);
  out.count(points_.size());  // bytes a row
  out.bytes(points_);
  out.u8(1);  // no point is missing
  return message;
}

}  // namespace swiftlet::ros2
