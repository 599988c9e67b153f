// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/tf_chain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "swiftlet/source/bag/bag_scan.hpp"

namespace swiftlet {
namespace {

using Ties = std::map<std::string, TfChain::Tie, std::less<>>;  // by the child; the first stays

constexpr std::size_t kMostFrames = 10'000;
// So far every tie is waited for that may hang the root on something more; an image has a megabyte.
constexpr std::uint64_t kBytesWithTree = 200U << 20U;

void note_ties(const BagMessage& message, Ties& ties) {
  const auto poses = ros::parse_poses(message.connection->type, message.serialized());
  if (!poses) return;
  for (const ros::StampedPose& pose : *poses) {
    const std::string child(plain_name(pose.child));
    if (ties.size() == kMostFrames || child.empty()) return;
    ties.try_emplace(child, TfChain::Tie{child, std::string(plain_name(pose.parent)),
                                         is_static_tf(message.connection->topic), pose.pose});
  }
}

std::vector<std::string> frames_of(const Ties& ties) {
  std::vector<std::string> frames;
  for (const auto& [child, tie] : ties) frames.push_back(child);
  return frames;
}

/// From a frame up to the world, or to the root; in a ring of frames until it is closed.
std::vector<TfChain::Tie> climb(const Ties& ties, std::string_view from, std::string_view world) {
  std::vector<TfChain::Tie> chain;
  for (auto tie = ties.find(from); tie != ties.end() && tie->first != world;
       tie = ties.find(tie->second.parent)) {
    chain.push_back(tie->second);
    if (chain.size() == ties.size()) break;
  }
  return chain;
}

Expected<TfChain> chain_in(const Ties& ties, const BagTopics& topics, const std::string& place) {
  const bool is_named = !topics.body_frame.empty();
  const std::string_view from = plain_name(is_named ? topics.body_frame : topics.camera_frame);
  const std::string_view world = plain_name(topics.world_frame);
  const std::vector<std::string> frames = frames_of(ties);
  if (is_named && !ties.contains(from)) {
    return fail(ErrorCode::kNotFound, place, fmt::format("there is no frame {}", from),
                names_instead(topics.body_frame, frames));
  }
  TfChain chain{climb(ties, from, world)};
  if (!is_named) {
    const auto lowest = std::ranges::find(chain.ties, false, &TfChain::Tie::is_static);
    chain.ties.erase(chain.ties.begin(), lowest);
  }
  if (std::ranges::find(chain.ties, false, &TfChain::Tie::is_static) == chain.ties.end()) {
    return fail(
        ErrorCode::kUsage, place,
        from.empty() ? "a tf topic holds the poses of many frames"
                     : fmt::format("nothing of tf moves that the frame '{}' hangs on", from),
        fmt::format("say which is the vehicle with --body-frame: {}", fmt::join(frames, ", ")));
  }
  if (chain.world() != world && ties.contains(chain.world())) {
    return fail(ErrorCode::kCorruptInput, place,
                fmt::format("the frames that '{}' hangs on are a ring", from),
                "name one of them with --world-frame");
  }
  if (!world.empty() && chain.world() != world) {
    return fail(
        ErrorCode::kNotFound, place,
        fmt::format("'{}' does not hang on '{}' but on '{}'", chain.body(), world, chain.world()),
        "name one of the frames between with --world-frame, or none");
  }
  return chain;
}

}  // namespace

bool is_static_tf(std::string_view topic) { return topic.ends_with("tf_static"); }

bool is_wanted_tf(const BagConnection& connection, const BagTopics& topics) {
  return ros::is_tf_type(connection.type) &&
         (topics.pose.empty() || is_static_tf(connection.topic) ||
          is_same_name(connection.topic, topics.pose));
}

Expected<TfChain> find_tf_chain(RecordingReader& reader, const BagTopics& topics) {
  Ties ties;
  const std::string place =
      fmt::format("{} ({})", reader.name(), topics.pose.empty() ? "/tf" : topics.pose);
  const auto scanned = scan_bag(reader, [&](const BagMessage& message) {
    if (!is_wanted_tf(*message.connection, topics)) return false;
    note_ties(message, ties);
    return reader.bytes_read() > kBytesWithTree && chain_in(ties, topics, place).has_value();
  });
  if (!scanned && ties.empty()) return tl::make_unexpected(scanned.error());
  return chain_in(ties, topics, place);
}

}  // namespace swiftlet
