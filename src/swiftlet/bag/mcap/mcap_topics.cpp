// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/mcap/mcap_topics.hpp"

#include <fmt/format.h>

#include <string_view>

#include "swiftlet/bag/message_types.hpp"

namespace swiftlet::mcap {
namespace {

MessageEncoding encoding_of(std::string_view name) {
  if (name == "cdr") return MessageEncoding::kCdr;
  if (name == "ros1") return MessageEncoding::kRos1;
  return MessageEncoding::kOther;
}

}  // namespace

std::optional<std::string> McapTopics::add_schema(Body body) {
  const auto schema = parse_schema(body);
  if (!schema || schema->id == 0 || schema->name.size() > kMostNameBytes)
    return "a schema here is malformed";
  const std::string type = plain_type_name(schema->name);
  const auto [place, is_new] = type_by_schema_.emplace(schema->id, type);
  if (!is_new && place->second != type) return "two schemas share one number";
  return std::nullopt;
}

std::optional<std::string> McapTopics::add_channel(Body body) {
  const auto channel = parse_channel(body);
  if (!channel || channel->topic.size() > kMostNameBytes) return "a channel here is malformed";
  const auto known = channels_.find(channel->id);
  if (known != channels_.end()) {
    if (known->second.topic == channel->topic) return std::nullopt;
    return "two topics share one number";
  }
  const auto type = type_by_schema_.find(channel->schema_id);
  if (channel->schema_id != 0 && type == type_by_schema_.end())
    return fmt::format("the schema of {} is missing", channel->topic);
  channels_.emplace(channel->id,
                    BagConnection{.id = channel->id,
                                  .topic = std::string(channel->topic),
                                  .type = channel->schema_id == 0 ? std::string() : type->second,
                                  .encoding = encoding_of(channel->message_encoding)});
  return std::nullopt;
}

}  // namespace swiftlet::mcap
