// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "swiftlet/bag/messages/message_definitions.hpp"
#include "swiftlet/base/byte_writer.hpp"
#include "swiftlet/station/client_protocol.hpp"
#include "swiftlet/station/foxglove/foxglove_messages.hpp"

namespace swiftlet::station {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxSubscriptions = 64;

/// What /statistics holds, for readers that want to know before it comes.
constexpr std::string_view kStatisticsSchema = R"({"type":"object","properties":{
"frame_count":{"type":"integer"},"memory_bytes":{"type":"integer"},"blocks":{"type":"integer"},
"occupied":{"type":"integer"},"free":{"type":"integer"},"verdicts":{"type":"object"},
"lost":{"type":"object"},"stage_ms":{"type":"object"},"readings":{"type":"integer"},
"voxels":{"type":"integer"},"blocks_left":{"type":"integer"}}})";

Outgoing text_of(const json& message) {
  const std::string text = message.dump(-1, ' ', false, json::error_handler_t::replace);
  return {true, Bytes(text.begin(), text.end())};
}

json advertisement() {
  json channels = json::array();
  std::uint32_t id = 0;
  for (const FoxgloveChannel& channel : foxglove_channels()) {
    const bool is_json = channel.schema.empty();
    std::string name = is_json ? "swiftlet.Statistics" : std::string(channel.schema);
    if (!is_json) name.insert(name.find('/'), "/msg");
    channels.push_back(
        {{"id", ++id},
         {"topic", channel.topic},
         {"encoding", is_json ? "json" : "cdr"},
         {"schemaName", name},
         {"schema", is_json ? std::string(kStatisticsSchema) : message_definition(channel.schema)},
         {"schemaEncoding", is_json ? "jsonschema" : "ros2msg"}});
  }
  return {{"op", "advertise"}, {"channels", channels}};
}

/// A client of the Foxglove WebSocket protocol. Of each channel it is sent the newest state when
/// the one before has left, so that a slow client gets fewer of them.
class FoxgloveProtocol final : public ClientProtocol {
 public:
  explicit FoxgloveProtocol(const MapModel& model) : model_(model) {}

  void saw(const MapModel::Update& update) override {
    for (Subscription& s : subscriptions_) {
      switch (s.channel->follows) {
        case FoxgloveChannel::Follows::kMap:
          s.is_due |= !update.changed.empty();
          break;
        case FoxgloveChannel::Follows::kFrames:
          s.is_due |= !update.frames.empty();
          break;
        case FoxgloveChannel::Follows::kDepth:
          s.is_due |= update.has_depth;
          break;
      }
    }
  }
  void count(std::uint32_t) override {}
  [[nodiscard]] bool wants_depth() const override {
    return std::ranges::any_of(subscriptions_, [](const Subscription& s) {
      return s.channel->follows == FoxgloveChannel::Follows::kDepth;
    });
  }

  std::optional<Outgoing> next(Time now) override {
    if (greetings_ < 2) return greeting();
    if (model_.world() == 0) return std::nullopt;
    for (std::size_t i = 0; i < subscriptions_.size(); ++i) {
      Subscription& s = subscriptions_[(turn_ + i) % subscriptions_.size()];
      if (!s.is_due || now < s.not_before) continue;
      s.is_due = false;
      s.not_before = now + std::chrono::duration_cast<std::chrono::nanoseconds>(
                               std::chrono::duration<double>(1.0 / s.channel->max_hz));
      const Bytes payload = s.channel->message(model_);
      if (payload.empty()) continue;
      turn_ = (turn_ + i + 1) % subscriptions_.size();
      return message_data(s.id, payload);
    }
    return std::nullopt;
  }

  Status received(bool is_text, std::span<const std::uint8_t> bytes, Time) override {
    const auto refuse = [](const char* what) {
      return fail(ErrorCode::kCorruptInput, "foxglove client", what);
    };
    if (!is_text) return refuse("binary messages are for services, which there are none of");
    const json message = json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (!message.is_object() || !message.contains("op")) return refuse("no JSON object with 'op'");
    if (message["op"] == "subscribe") return subscribe(message);
    if (message["op"] == "unsubscribe") return unsubscribe(message);
    return Done{};  // of what this server does not say it can, clients ask at their own risk
  }

 private:
  struct Subscription {
    std::uint32_t id;
    const FoxgloveChannel* channel;
    bool is_due = true;  // at once: what there is
    Time not_before{};
  };

  Outgoing greeting() {
    if (greetings_++ > 0) return text_of(advertisement());
    static const std::string kSession = fmt::format("{:08x}", std::random_device{}());
    return text_of({{"op", "serverInfo"},
                    {"name", "swiftlet"},
                    {"capabilities", json::array()},
                    {"supportedEncodings", json::array()},
                    {"metadata", json::object()},
                    {"sessionId", kSession}});
  }

  Outgoing message_data(std::uint32_t id, const Bytes& payload) const {
    Outgoing out{false, {}};
    out.data.reserve(payload.size() + 13);
    ByteWriter writer(out.data);
    writer.u8(1);
    writer.u32(id);
    writer.u64(model_.last_frame() ? static_cast<std::uint64_t>(model_.last_frame()->stamp.ns) : 0);
    writer.bytes(payload);
    return out;
  }

  /// A number of the message that must be there and fit.
  static std::optional<std::uint32_t> number(const json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number_unsigned()) {
      return std::nullopt;
    }
    const auto value = object[key].get<std::uint64_t>();
    return value <= 0xffffffffU ? std::optional(static_cast<std::uint32_t>(value)) : std::nullopt;
  }

  Status subscribe(const json& message) {
    const auto list = message.find("subscriptions");
    if (list == message.end() || !list->is_array()) {
      return fail(ErrorCode::kCorruptInput, "foxglove client", "no list of subscriptions");
    }
    for (const json& wanted : *list) {
      const auto id = number(wanted, "id");
      const auto channel = number(wanted, "channelId");
      if (!id || !channel || *channel == 0 || *channel > foxglove_channels().size()) {
        return fail(ErrorCode::kCorruptInput, "foxglove client", "no such channel");
      }
      if (subscriptions_.size() == kMaxSubscriptions) {
        return fail(ErrorCode::kCorruptInput, "foxglove client", "too many subscriptions");
      }
      subscriptions_.push_back({*id, &foxglove_channels()[*channel - 1]});
    }
    return Done{};
  }

  Status unsubscribe(const json& message) {
    const auto list = message.find("subscriptionIds");
    if (list == message.end() || !list->is_array()) {
      return fail(ErrorCode::kCorruptInput, "foxglove client", "no list of subscriptions");
    }
    for (const json& id : *list) {
      std::erase_if(subscriptions_, [&](const Subscription& s) { return id == s.id; });
    }
    turn_ = 0;
    return Done{};
  }

  const MapModel& model_;
  std::vector<Subscription> subscriptions_;
  std::size_t turn_ = 0;  // whose turn it is, so that none starves
  int greetings_ = 0;
};

}  // namespace

std::unique_ptr<ClientProtocol> make_foxglove_protocol(const MapModel& model) {
  return std::make_unique<FoxgloveProtocol>(model);
}

}  // namespace swiftlet::station
