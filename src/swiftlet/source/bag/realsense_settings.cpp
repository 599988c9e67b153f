// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/realsense_settings.hpp"

#include <optional>
#include <string_view>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/realsense_topics.hpp"
#include "swiftlet/source/text_file.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kDataTail = "/image/data";
constexpr std::string_view kLaserPower = "Laser_Power";

void note_pair(const ros::KeyValue& pair, CaptureSettings& settings) {
  if (pair.key == "Actual Exposure") settings.exposure_us = parse_number(pair.value);
  // "Laser Power" before SDK 2.22.
  if (pair.key == "Frame Laser Power" || pair.key == "Laser Power")
    settings.laser_mw = parse_number(pair.value);
}

}  // namespace

Expected<std::vector<CaptureSettings>> read_realsense_settings(const std::filesystem::path& path,
                                                               const std::string& data_topic) {
  std::vector<CaptureSettings> all;
  if (!depth_stream_of(data_topic)) return all;
  const std::string stream = data_topic.substr(0, data_topic.size() - kDataTail.size());
  const std::string metadata_topic = stream + "/image/metadata";
  auto reader = open_recording(path);
  if (!reader) return forward_error(std::move(reader));
  std::optional<double> laser_mw;  // by the option
  Stamp last;
  auto read = scan_bag(**reader, [&](const BagMessage& message) {
    const std::string& topic = message.connection->topic;
    if (topic == data_topic) {
      all.push_back({std::nullopt, laser_mw});
      last = message.record_time;
    } else if (topic == metadata_topic && !all.empty() && message.record_time == last) {
      if (const auto pair = ros::parse_key_value(message.serialized()))
        note_pair(*pair, all.back());
    } else if (is_option_of(topic, stream, kLaserPower)) {
      if (const auto power = ros::parse_float32(message.serialized())) laser_mw = double{*power};
    }
    return false;
  });
  if (!read) return forward_error(std::move(read));
  return all;
}

}  // namespace swiftlet
