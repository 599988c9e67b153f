// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "swiftlet/base/time.hpp"

namespace swiftlet::test {

/// In which of the ways that ROS has a message is serialised.
enum class Wire { kRos1, kCdr, kCdrBigEndian, kCdr2 };

/// Serialises the fields of a message in any of these ways, so that a test can demand the same of
/// all. Whether it does so rightly, the recordings of others tell.
class MessageWriter {
 public:
  explicit MessageWriter(Wire wire) : wire_(wire) {
    const char kind = wire == Wire::kCdr ? '\1' : wire == Wire::kCdr2 ? '\7' : '\0';
    if (wire != Wire::kRos1) text_ = {'\0', kind, '\0', '\0'};
    start_ = text_.size();
  }

  template <class Value>
  MessageWriter& add(Value value) {
    const std::size_t most = wire_ == Wire::kRos1 ? 1 : wire_ == Wire::kCdr2 ? 4 : 8;
    while ((text_.size() - start_) % std::min(most, sizeof(Value)) != 0) text_ += '\0';
    char raw[sizeof(Value)];
    std::memcpy(raw, &value, sizeof(Value));
    if (wire_ == Wire::kCdrBigEndian) std::reverse(std::begin(raw), std::end(raw));
    text_.append(raw, sizeof(Value));
    return *this;
  }
  MessageWriter& bytes(std::string_view data) {
    add(static_cast<std::uint32_t>(data.size()));
    text_ += data;
    return *this;
  }
  /// So many structures follow, until end_structs(); XCDR2 has their length before them (DDS-XTypes
  /// 1.3, 7.4.3.5.3).
  MessageWriter& structs(std::uint32_t count) {
    if (wire_ == Wire::kCdr2) {
      add(std::uint32_t{0});
      length_at_ = text_.size() - sizeof(std::uint32_t);
    }
    return add(count);
  }
  MessageWriter& end_structs() {
    if (wire_ != Wire::kCdr2) return *this;
    const auto length =
        static_cast<std::uint32_t>(text_.size() - length_at_ - sizeof(std::uint32_t));
    std::memcpy(text_.data() + length_at_, &length, sizeof(length));
    return *this;
  }
  MessageWriter& string(std::string_view text) {
    return bytes(wire_ == Wire::kRos1 ? std::string(text) : std::string(text) + '\0');
  }
  MessageWriter& header(Stamp stamp, std::string_view frame) {
    if (wire_ == Wire::kRos1) add(std::uint32_t{0});  // seq
    return add(static_cast<std::uint32_t>(stamp.ns / 1'000'000'000))
        .add(static_cast<std::uint32_t>(stamp.ns % 1'000'000'000))
        .string(frame);
  }
  MessageWriter& pose(const Eigen::Vector3d& t_m, const Eigen::Quaterniond& R) {
    for (const double v : {t_m.x(), t_m.y(), t_m.z(), R.x(), R.y(), R.z(), R.w()}) add(v);
    return *this;
  }
  template <class Value>
  MessageWriter& zeros(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(Value{});
    return *this;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  Wire wire_;
  std::string text_;
  std::size_t start_ = 0;
  std::size_t length_at_ = 0;  // where the length of the structures stands
};

}  // namespace swiftlet::test
