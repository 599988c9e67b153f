// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/realsense_topics.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "swiftlet/source/text_file.hpp"

namespace swiftlet {
namespace {

std::optional<std::string> stream_of(std::string_view topic, std::string_view kind,
                                     std::string_view tail) {
  if (!topic.starts_with("/device_") || !topic.ends_with(tail)) return std::nullopt;
  const std::string_view stream = topic.substr(0, topic.size() - tail.size());
  const std::size_t slash = stream.rfind('/');
  if (!stream.substr(slash + 1).starts_with(kind)) return std::nullopt;
  return std::string(stream);
}

}  // namespace

std::optional<std::string> depth_stream_of(std::string_view topic) {
  return stream_of(topic, "Depth_", "/image/data");
}

std::optional<std::string> pose_stream_of(std::string_view topic) {
  return stream_of(topic, "Pose_", "/pose/transform/data");
}

bool is_option_of(std::string_view topic, std::string_view stream, std::string_view option) {
  const std::string_view sensor = stream.substr(0, stream.rfind('/'));
  std::string name(topic);
  std::ranges::replace(name, ' ', '_');
  return name == std::string(sensor) + "/option/" + std::string(option) + "/value";
}

ClockDomain clock_from_name(std::string_view name) {
  if (name == "Global Time") return ClockDomain::kGlobal;
  if (name == "System Time") return ClockDomain::kSystem;
  if (name == "Hardware Clock") return ClockDomain::kDevice;
  return ClockDomain::kUnspecified;
}

std::optional<Stamp> stamp_from_milliseconds(std::string_view text) {
  std::optional<double> ms;
  if (text.starts_with("0x")) {
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(text.data() + 2, text.data() + text.size(), value, std::chars_format::hex);
    if (error == std::errc{} && end == text.data() + text.size()) ms = value;
  } else {
    ms = parse_number(text);
  }
  return ms ? stamp_from_milliseconds(*ms) : std::nullopt;
}

std::optional<Stamp> stamp_from_milliseconds(double ms) {
  // An unsigned 64-bit count of ns would be wrong from the year 2262 on; doubles are exact to 0.3
  // us today.
  if (!(std::abs(ms) < 9.2e12)) return std::nullopt;
  const double whole_ms = std::floor(ms);
  return Stamp{std::llround(whole_ms) * 1'000'000 + std::llround((ms - whole_ms) * 1e6)};
}

}  // namespace swiftlet
