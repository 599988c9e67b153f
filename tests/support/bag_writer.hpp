// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <fmt/format.h>
#include <lz4frame.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/image.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet::test {

/// The bytes of little-endian values, one after the other.
class Bytes {
 public:
  template <class Value>
  Bytes& add(Value value) {
    char raw[sizeof(Value)];
    std::memcpy(raw, &value, sizeof(Value));
    text_.append(raw, sizeof(Value));
    return *this;
  }
  Bytes& raw(std::string_view bytes) {
    text_ += bytes;
    return *this;
  }
  Bytes& string(std::string_view text) {
    return add(static_cast<std::uint32_t>(text.size())).raw(text);
  }
  Bytes& time(Stamp t) {
    return add(static_cast<std::uint32_t>(t.ns / 1'000'000'000))
        .add(static_cast<std::uint32_t>(t.ns % 1'000'000'000));
  }
  Bytes& header(std::uint32_t seq, Stamp stamp, std::string_view frame) {
    return add(seq).time(stamp).string(frame);
  }
  Bytes& pose(const Eigen::Vector3d& t_m, const Eigen::Quaterniond& R) {
    return add(t_m.x()).add(t_m.y()).add(t_m.z()).add(R.x()).add(R.y()).add(R.z()).add(R.w());
  }
  Bytes& zeros(std::size_t count) { return raw(std::string(count, '\0')); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Writes ROS bags (format 2.0) for tests, without an index, as a recorder leaves them that was
/// killed.
class BagWriter {
 public:
  explicit BagWriter(std::string compression = "none") : compression_(std::move(compression)) {
    const std::string header = field("op", std::string(1, '\x03')) +
                               field("index_pos", Bytes().add(std::uint64_t{0}).text()) +
                               field("conn_count", Bytes().add(std::uint32_t{0}).text()) +
                               field("chunk_count", Bytes().add(std::uint32_t{0}).text());
    bag_ = "#ROSBAG V2.0\n" + record(header, std::string(64, ' '));
  }

  /// Adds a message to the chunk that is being filled.
  void message(const std::string& topic, const std::string& type, Stamp time,
               const std::string& data) {
    const auto [connection, is_new] =
        connections_.emplace(topic, static_cast<std::uint32_t>(connections_.size()));
    const std::string number = Bytes().add(connection->second).text();
    if (is_new) {
      chunk_ += record(
          field("op", std::string(1, '\x07')) + field("conn", number) + field("topic", topic),
          field("topic", topic) + field("type", type) + field("md5sum", "*"));
    }
    chunk_ += record(field("op", std::string(1, '\x02')) + field("conn", number) +
                         field("time", Bytes().time(time).text()),
                     data);
  }

  /// Ends the chunk. Returns where the file ends now.
  std::size_t end_chunk() {
    const std::string packed = compression_ == "lz4" ? lz4(chunk_) : chunk_;
    const auto size = static_cast<std::uint32_t>(chunk_.size());
    bag_ += record(field("op", std::string(1, '\x05')) + field("compression", compression_) +
                       field("size", Bytes().add(size).text()),
                   packed);
    chunk_.clear();
    return bag_.size();
  }

  [[nodiscard]] const std::string& bag() const { return bag_; }

  static std::string field(const std::string& name, const std::string& value) {
    return Bytes().string(name + "=" + value).text();
  }
  static std::string record(const std::string& header, const std::string& data) {
    return Bytes().string(header).string(data).text();
  }

 private:
  static std::string lz4(const std::string& text) {
    LZ4F_preferences_t preferences{};
    preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;  // as roslz4 does
    std::string packed(LZ4F_compressFrameBound(text.size(), &preferences), '\0');
    packed.resize(
        LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), &preferences));
    return packed;
  }

  std::string compression_, bag_, chunk_;
  std::map<std::string, std::uint32_t> connections_;
};

/// sensor_msgs/Image of 16-bit pixels.
[[nodiscard]] inline std::string image_message(const Image<std::uint16_t>& pixels, Stamp stamp,
                                               std::string_view encoding = "16UC1",
                                               std::string_view frame = "depth_optical") {
  std::string raw(pixels.pixels().size_bytes(), '\0');
  std::memcpy(raw.data(), pixels.pixels().data(), raw.size());
  return Bytes()
      .header(0, stamp, frame)
      .add(static_cast<std::uint32_t>(pixels.height()))
      .add(static_cast<std::uint32_t>(pixels.width()))
      .string(encoding)
      .add(std::uint8_t{0})
      .add(static_cast<std::uint32_t>(2 * pixels.width()))
      .string(raw)
      .text();
}

/// What a CameraInfo tells beside the pinhole K of the middle.
struct InfoExtras {
  Stamp stamp{};
  double cx = -1.0, cy = -1.0;  ///< negative: in the middle
  std::array<std::uint32_t, 2> binning{};
  std::array<std::uint32_t, 4> region{};  ///< x, y, height, width
};

/// sensor_msgs/CameraInfo with the pinhole K.
[[nodiscard]] inline std::string info_message(int width, int height, double f_px,
                                              const std::vector<double>& D = {},
                                              const InfoExtras& extras = {}) {
  Bytes bytes;
  bytes.header(0, extras.stamp, "depth_optical")
      .add(static_cast<std::uint32_t>(height))
      .add(static_cast<std::uint32_t>(width))
      .string("plumb_bob")
      .add(static_cast<std::uint32_t>(D.size()));
  for (const double d : D) bytes.add(d);
  const double cx = extras.cx < 0.0 ? 0.5 * width : extras.cx;
  const double cy = extras.cy < 0.0 ? 0.5 * height : extras.cy;
  for (const double k : {f_px, 0.0, cx, 0.0, f_px, cy, 0.0, 0.0, 1.0}) bytes.add(k);
  bytes.zeros(21 * sizeof(double));
  for (const std::uint32_t value : extras.binning) bytes.add(value);
  for (const std::uint32_t value : extras.region) bytes.add(value);
  return bytes.zeros(1).text();
}

/// nav_msgs/Odometry.
[[nodiscard]] inline std::string odometry_message(
    Stamp stamp, const Eigen::Vector3d& t_m,
    const Eigen::Quaterniond& R = Eigen::Quaterniond::Identity()) {
  return Bytes()
      .header(0, stamp, "odom")
      .string("base_link")
      .pose(t_m, R)
      .zeros((36 + 6 + 36) * sizeof(double))
      .text();
}

/// tf2_msgs/TFMessage of one transform.
[[nodiscard]] inline std::string tf_message(
    Stamp stamp, std::string_view parent, std::string_view child, const Eigen::Vector3d& t_m,
    const Eigen::Quaterniond& R = Eigen::Quaterniond::Identity()) {
  return Bytes().add(std::uint32_t{1}).header(0, stamp, parent).string(child).pose(t_m, R).text();
}

}  // namespace swiftlet::test
