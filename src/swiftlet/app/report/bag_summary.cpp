// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/bag_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"

namespace swiftlet::app {
namespace {

constexpr std::string_view kDeviceInfo = "/device_0/info";

void add_time(Stamp t, BagTopicSummary& topic) {
  if (topic.messages++ == 0) topic.first = topic.last = topic.newest = t;
  if (t - topic.newest > topic.longest_gap) {
    topic.longest_gap = t - topic.newest;
    topic.gap_begin = topic.newest;
  }
  topic.newest = t;
  topic.first = std::min(topic.first, t);
  topic.last = std::max(topic.last, t);
}

void add(const BagMessage& message, BagSummary& summary) {
  BagTopicSummary& topic = summary.topics[message.connection->topic];
  topic.type = message.connection->type;
  topic.is_read = message.connection->encoding != MessageEncoding::kOther;
  add_time(message.record_time, topic);
  if (topic.frames.size() < BagTopicSummary::kMostFrames) {
    for (std::string& frame : ros::parse_frames(topic.type, message.serialized()))
      topic.frames.insert(std::move(frame));
  }
  if (message.connection->topic != kDeviceInfo) return;
  if (const auto pair = ros::parse_key_value(message.serialized()))
    summary.device.emplace_back(pair->key, pair->value);
}

/// Topics without a message, too.
void add_silent(const RecordingReader& reader, BagSummary& summary) {
  for (const auto& [number, connection] : reader.connections())
    summary.topics[connection.topic].type = connection.type;
}

/// What would be mapped without another option, or why nothing would be.
void add_choices(BagSummary& summary) {
  const auto depth = open_bag_depth(summary.path, {});
  const auto poses = open_bag_poses(summary.path, {.camera_frame = depth ? depth->frame_id : ""});
  summary.choices.push_back(depth ? depth->told : "no depth: " + depth.error().what);
  summary.choices.push_back(poses ? poses->told : "no poses: " + poses.error().what);
}

std::string how_text(const RecordingInfo& how) {
  std::string text = how.format;
  if (how.files != 1) text += fmt::format(", {} files", how.files);
  if (how.chunks > 0)
    text += fmt::format(", {} chunks ({})", how.chunks, fmt::join(how.compression, ", "));
  return text + (how.is_closed ? "" : ", not closed by its recorder");
}

std::string topic_text(const BagTopicSummary& topic) {
  std::string text = visible(topic.type);
  if (const auto rate_hz = topic.rate_hz())
    text += fmt::format(", {:.1f} s, {:.1f} Hz", topic.duration_s(), *rate_hz);
  if (topic.has_gap())
    text += fmt::format(", gap of {:.2f} s after {:.2f} s", seconds(topic.longest_gap),
                        seconds(topic.gap_begin - topic.first));
  for (const std::string& frame : topic.frames)
    text += (frame == *topic.frames.begin() ? ", of " : " ") + visible(frame);
  return text + (topic.is_read ? "" : ", in an encoding that is not read");
}

}  // namespace

std::optional<double> BagTopicSummary::rate_hz() const {
  if (messages < 2 || duration_s() <= 0.0) return std::nullopt;
  return static_cast<double>(messages - 1) / duration_s();
}

bool BagTopicSummary::has_gap() const {
  constexpr double kOfRhythm = 3.0;
  constexpr std::uint64_t kFewest = 5;
  const auto hz = rate_hz();
  return hz && messages >= kFewest && seconds(longest_gap) * *hz > kOfRhythm;
}

Expected<BagSummary> summarize_bag(const std::string& path) {
  auto reader = open_recording(path);
  if (!reader) return forward_error(std::move(reader));
  BagSummary summary{.path = path};
  std::error_code is_folder;
  const auto bytes = std::filesystem::file_size(path, is_folder);
  if (!is_folder) summary.bytes = bytes;
  while (true) {
    auto message = (*reader)->next();
    if (!message) summary.fault = message.error();
    if (!message || !*message) break;
    add(**message, summary);
  }
  add_silent(**reader, summary);
  summary.how = (*reader)->info();
  if (!summary.fault) add_choices(summary);
  return summary;
}

std::string bag_text(const BagSummary& bag) {
  std::string text =
      fmt::format("{}{}: {}\n", visible(bag.path),
                  bag.bytes > 0 ? " (" + size_text(bag.bytes) + ")" : "", how_text(bag.how));
  for (const auto& [name, value] : bag.device) {
    if (name == "Name" || name == "Serial Number" || name == "Firmware Version")
      text += fmt::format("  {:<16} {}\n", name, visible(value));
  }
  std::size_t width = 0;
  for (const auto& [name, topic] : bag.topics) width = std::max(width, visible(name).size());
  for (const auto& [name, topic] : bag.topics) {
    text += fmt::format("  {:<{}}  {:>7}  {}\n", visible(name), width, topic.messages,
                        topic_text(topic));
  }
  for (const std::string& choice : bag.choices) text += fmt::format("  would map: {}\n", choice);
  return text;
}

std::string bag_json(const BagSummary& bag) {
  nlohmann::ordered_json json{
      {"path", bag.path},
      {"bytes", bag.bytes},
      {"format", bag.how.format},
      {"files", bag.how.files},
      {"is_closed", bag.how.is_closed},
      {"chunks", bag.how.chunks},
      {"compression", fmt::format("{}", fmt::join(bag.how.compression, ", "))}};
  for (const auto& [name, value] : bag.device) json["device"][name] = value;
  json["topics"] = nlohmann::ordered_json::array();
  for (const auto& [name, topic] : bag.topics) {
    json["topics"].push_back({{"name", name},
                              {"type", topic.type},
                              {"messages", topic.messages},
                              {"first_ns", topic.first.ns},
                              {"last_ns", topic.last.ns},
                              {"longest_gap_s", seconds(topic.longest_gap)},
                              {"frames", topic.frames}});
  }
  json["would_map"] = bag.choices;
  return json_text(json) + "\n";
}

}  // namespace swiftlet::app
