// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/bag_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/depth_message.hpp"

namespace swiftlet {
namespace {

constexpr int kPlainly = 3;  // evidence: depth by encoding and name, or so
constexpr std::uint64_t kBytesToCompare = 60U << 20U;  // an image has about one
constexpr std::size_t kMostCandidates = 64;

/// Whether a name has that word, set off by anything but a letter: "/ir/image" and "ir2", not
/// "mirror".
bool has_word(std::string_view name, std::string_view word) {
  const auto is_letter = [&](std::size_t i) {
    return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i])) != 0;
  };
  for (std::size_t at = name.find(word); at != std::string_view::npos;
       at = name.find(word, at + 1)) {
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size())) return true;
  }
  return false;
}

int evidence_of_name(std::string_view topic) {
  constexpr std::array<std::string_view, 9> kOthers{"ir",         "infra",     "infrared",
                                                    "intensity",  "amplitude", "amplitudes",
                                                    "confidence", "fisheye",   "mono"};
  std::string name(topic);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  int evidence = name.find("depth") != std::string::npos ? 2 : 0;
  if (std::ranges::any_of(kOthers, [&](std::string_view word) { return has_word(name, word); }))
    evidence -= 4;
  // The same depth as another camera would see it, with holes and edges that are not the sensor's.
  const bool is_moved =
      name.find("aligned") != std::string::npos || name.find("registered") != std::string::npos;
  return evidence - (is_moved ? 1 : 0);
}

int evidence_of(const ros::Image& image, std::string_view topic) {
  int evidence = evidence_of_name(topic) + (image.encoding == "mono16" ? 0 : 2);
  const auto depth = depth_from_message(image, 0.001F);
  if (!depth) return evidence;
  if (const auto smooth = smooth_share(*depth))
    evidence += *smooth > 0.6 ? 1 : *smooth < 0.3 ? -2 : 0;
  return evidence;
}

void note_image(const BagMessage& message, const ros::Image& image,
                std::vector<DepthCandidate>& candidates) {
  const std::string& topic = message.connection->topic;
  auto found = std::ranges::find(candidates, topic, &DepthCandidate::topic);
  if (found == candidates.end()) {
    if (candidates.size() == kMostCandidates) return;
    DepthCandidate fresh;
    fresh.topic = topic;
    fresh.encoding = image.encoding;
    fresh.frame_id = image.header.frame_id;
    fresh.width = static_cast<int>(std::min(image.width, 65535U));
    fresh.height = static_cast<int>(std::min(image.height, 65535U));
    fresh.first = message.record_time;
    fresh.evidence = evidence_of(image, topic);
    found = candidates.insert(candidates.end(), std::move(fresh));
  }
  ++found->images;
  found->last = message.record_time;
}

/// Depth that is not read, PNG or RVL behind a header of image_transport: the error that names it
/// and says what to do; nullopt if there is none.
std::optional<Error> compressed_depth(const RecordingReader& reader, std::string_view what) {
  for (const auto& [id, connection] : reader.connections()) {
    constexpr std::string_view kEnd = "/compressedDepth";
    const std::string& topic = connection.topic;
    if (connection.type != "sensor_msgs/CompressedImage" || !topic.ends_with(kEnd)) continue;
    const std::string plain = topic.substr(0, topic.size() - kEnd.size());
    return Error{ErrorCode::kUnsupported, reader.name(),
                 fmt::format("{}, but compressed depth on {}, which is not read", what, topic),
                 fmt::format("play the bag through `rosrun image_transport republish "
                             "compressedDepth in:={} raw out:=/depth/image_raw`, record that, and "
                             "name it with --depth-topic /depth/image_raw --info-topic "
                             "{}/camera_info",
                             plain, plain.substr(0, plain.rfind('/')))};
  }
  return std::nullopt;
}

std::string list_of(const std::vector<DepthCandidate>& candidates) {
  std::string text;
  for (const DepthCandidate& candidate : candidates)
    text += (text.empty() ? "" : ", ") + candidate.text();
  return text;
}

}  // namespace

std::string DepthCandidate::text() const {
  const double span_s = seconds(last - first);
  const std::string rate =
      images > 1 && span_s > 0.0
          ? fmt::format(", {:.1f} Hz", static_cast<double>(images - 1) / span_s)
          : "";
  return fmt::format("{} ({}, {} x {}{})", topic, encoding, width, height, rate);
}

Expected<std::vector<DepthCandidate>> survey_depth(RecordingReader& reader,
                                                   std::string_view wanted) {
  std::vector<DepthCandidate> candidates;
  std::optional<std::uint64_t> enough;  // bytes, from which on it need not go on
  auto scanned = scan_bag(reader, [&](const BagMessage& message) {
    if (enough && reader.bytes_read() > *enough) return true;
    const BagConnection& connection = *message.connection;
    if (connection.type != "sensor_msgs/Image") return false;
    if (!wanted.empty() && !is_same_name(connection.topic, wanted)) return false;
    const auto image = ros::parse_image(message.serialized());
    if (!image || (wanted.empty() && !may_be_depth(image->encoding))) return false;
    note_image(message, *image, candidates);
    if (!wanted.empty()) return true;
    const bool is_plain = std::ranges::any_of(
        candidates, [](const DepthCandidate& c) { return c.evidence >= kPlainly; });
    if (is_plain && !enough) enough = reader.bytes_read() + kBytesToCompare;
    return false;
  });
  if (!scanned && candidates.empty()) return forward_error(std::move(scanned));
  return candidates;
}

Expected<DepthCandidate> choose_depth(const RecordingReader& reader,
                                      const std::vector<DepthCandidate>& candidates,
                                      std::string_view wanted) {
  constexpr std::string_view kRemedy = "choose a topic with --depth-topic";
  if (!wanted.empty() && !candidates.empty()) return candidates.front();
  if (candidates.empty()) {
    const std::string what = wanted.empty() ? "it holds no depth images (16UC1, mono16 or 32FC1)"
                                            : fmt::format("it has no images on {}", wanted);
    if (auto compressed = compressed_depth(reader, what))
      return tl::make_unexpected(std::move(*compressed));
    return no_such_topic(reader, what, kRemedy, wanted);
  }
  const auto best = std::ranges::max_element(candidates, {}, &DepthCandidate::evidence);
  if (best->evidence < 1) {
    return fail(ErrorCode::kNotFound, reader.name(),
                fmt::format("none of its images is plainly depth: {}", list_of(candidates)),
                std::string(kRemedy) + " if one is");
  }
  if (std::ranges::count(candidates, best->evidence, &DepthCandidate::evidence) > 1) {
    return fail(ErrorCode::kUsage, reader.name(),
                fmt::format("several of its topics may be the depth: {}", list_of(candidates)),
                std::string(kRemedy) + ", or with 'stream' in a rig file");
  }
  return *best;
}

}  // namespace swiftlet
