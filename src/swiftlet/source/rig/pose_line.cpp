// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/pose_line.hpp"

#include <fmt/format.h>

#include <array>

#include "swiftlet/source/text_file.hpp"

namespace swiftlet {

Expected<PoseSample> parse_pose_line(std::string_view line, BodyAxes axes) {
  return parse_pose_words(words_of(line), axes);
}

Expected<PoseSample> parse_pose_words(std::span<const std::string_view> words, BodyAxes axes) {
  if (words.size() != 8 && words.size() != 9) {
    return fail(ErrorCode::kCorruptInput, {},
                fmt::format("a pose has 8 or 9 columns, this line {}", words.size()),
                fmt::format("write {}", kPoseColumns));
  }
  auto stamp = parse_stamp(words[0]);
  if (!stamp) return forward_error(std::move(stamp));
  if (stamp->ns < 0) return fail(ErrorCode::kCorruptInput, {}, "its time is before 1970");
  std::array<double, 8> value{};
  value.back() = 3.0;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto number = parse_number(words[i]);
    if (!number) {
      return fail(ErrorCode::kCorruptInput, {}, fmt::format("'{:.40}' is not a number", words[i]),
                  fmt::format("write {}", kPoseColumns));
    }
    value[i - 1] = *number;
  }
  const auto [x, y, z, qx, qy, qz, qw, confidence] = value;
  if (!(confidence >= 0.0 && confidence <= 3.0))
    return fail(ErrorCode::kCorruptInput, {}, "the confidence is not 0 to 3");
  return in_our_axes({*stamp,
                      Eigen::Quaterniond(qw, qx, qy, qz),
                      {x, y, z},
                      static_cast<std::uint8_t>(confidence)},
                     axes);
}

std::string pose_line(const PoseSample& pose) {
  const Eigen::Quaterniond& q = pose.R_world_body;
  const Eigen::Vector3d& t = pose.t_world_body_m;
  return fmt::format("{}.{:09} {} {} {} {} {} {} {} {}", pose.stamp.ns / 1'000'000'000,
                     pose.stamp.ns % 1'000'000'000, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(),
                     pose.confidence);
}

}  // namespace swiftlet
