// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/bag_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/bag/bag_reader.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"

namespace swiftlet::app {
namespace {

constexpr std::string_view kDeviceInfo = "/device_0/info";

void add(const BagMessage& message, BagSummary& summary) {
  const auto [place, is_new] = summary.topics.try_emplace(message.connection->topic);
  BagTopicSummary& topic = place->second;
  if (is_new) topic = {message.connection->type, 0, message.record_time, message.record_time};
  ++topic.messages;
  topic.first = std::min(topic.first, message.record_time);
  topic.last = std::max(topic.last, message.record_time);
  if (message.connection->topic != kDeviceInfo) return;
  if (const auto pair = ros::parse_key_value(message.data))
    summary.device.emplace_back(pair->key, pair->value);
}

std::string compression_of(const BagReader& reader) {
  constexpr std::array<std::string_view, 3> kNames{"none", "lz4", "bz2"};
  std::vector<std::string_view> used;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (reader.chunks_by_compression()[i] > 0) used.push_back(kNames[i]);
  }
  return fmt::format("{}", fmt::join(used, ", "));
}

/// What would be mapped without another option, or why nothing would be.
void add_choices(BagSummary& summary) {
  const auto depth = open_bag_depth(summary.path, {});
  const auto poses = open_bag_poses(summary.path, {});
  summary.choices.push_back(depth ? depth->told : "no depth: " + depth.error().what);
  summary.choices.push_back(poses ? poses->told : "no poses: " + poses.error().what);
}

double duration_s(const BagTopicSummary& topic) { return seconds(topic.last - topic.first); }

}  // namespace

Expected<BagSummary> summarize_bag(const std::string& path) {
  auto bytes = open_file_bytes(path);
  if (!bytes) return forward_error(std::move(bytes));
  BagSummary summary{.path = path, .bytes = (*bytes)->size()};
  auto reader = BagReader::open(std::move(*bytes));
  if (!reader) return forward_error(std::move(reader));
  while (true) {
    auto message = reader->next();
    if (!message) summary.fault = message.error();
    if (!message || !*message) break;
    add(**message, summary);
  }
  summary.chunks = reader->chunks_read();
  summary.compression = compression_of(*reader);
  if (!summary.fault) add_choices(summary);
  return summary;
}

std::string bag_text(const BagSummary& bag) {
  std::string text = fmt::format("{} ({}): ROS bag 2.0, {} chunks ({})\n", visible(bag.path),
                                 size_text(bag.bytes), bag.chunks, bag.compression);
  for (const auto& [name, value] : bag.device) {
    if (name == "Name" || name == "Serial Number" || name == "Firmware Version")
      text += fmt::format("  {:<16} {}\n", name, visible(value));
  }
  std::size_t width = 0;
  for (const auto& [name, topic] : bag.topics) width = std::max(width, visible(name).size());
  for (const auto& [name, topic] : bag.topics) {
    text += fmt::format("  {:<{}}  {:>7}  {}", visible(name), width, topic.messages,
                        visible(topic.type));
    if (topic.messages > 1 && duration_s(topic) > 0.0) {
      text += fmt::format(", {:.1f} s, {:.1f} Hz", duration_s(topic),
                          static_cast<double>(topic.messages - 1) / duration_s(topic));
    }
    text += "\n";
  }
  for (const std::string& choice : bag.choices) text += fmt::format("  would map: {}\n", choice);
  return text;
}

std::string bag_json(const BagSummary& bag) {
  nlohmann::ordered_json json{{"path", bag.path},
                              {"bytes", bag.bytes},
                              {"format", "ROS bag 2.0"},
                              {"chunks", bag.chunks},
                              {"compression", bag.compression}};
  for (const auto& [name, value] : bag.device) json["device"][name] = value;
  json["topics"] = nlohmann::ordered_json::array();
  for (const auto& [name, topic] : bag.topics) {
    json["topics"].push_back({{"name", name},
                              {"type", topic.type},
                              {"messages", topic.messages},
                              {"first_ns", topic.first.ns},
                              {"last_ns", topic.last.ns}});
  }
  json["would_map"] = bag.choices;
  return json_text(json) + "\n";
}

}  // namespace swiftlet::app
