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
#include "swiftlet/source/bag/depth_decoder.hpp"
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

/// The same depth may come in several forms: the image itself comes before what it was packed into,
/// and that before the points that were made of it.
int evidence_of_type(std::string_view type, std::string_view topic) {
  if (type == "sensor_msgs/Image") return 0;
  if (type == "sensor_msgs/PointCloud2") return -3;
  return topic.ends_with("/compressedDepth") ? -1 : -2;
}

/// What the first message of a topic tells of it.
void look_closely(const BagMessage& message, DepthCandidate& candidate) {
  candidate.evidence = evidence_of_name(candidate.topic) +
                       evidence_of_type(candidate.type, candidate.topic) +
                       (candidate.encoding == "mono16" ? 0 : 2);
  const auto decoded = decode_depth(message, 0.001F);
  if (!decoded && candidate.type == "sensor_msgs/PointCloud2") candidate.evidence = 0;
  if (!decoded) return;
  candidate.width = decoded->depth.raw.width();
  candidate.height = decoded->depth.raw.height();
  candidate.camera = decoded->camera;
  if (candidate.camera) candidate.evidence += 2;  // points that are an image's, to a pixel
  if (const auto smooth = smooth_share(decoded->depth))
    candidate.evidence += *smooth > 0.6 ? 1 : *smooth < 0.3 ? -2 : 0;
}

void note_image(const BagMessage& message, const DepthHead& head,
                std::vector<DepthCandidate>& candidates) {
  const std::string& topic = message.connection->topic;
  auto found = std::ranges::find(candidates, topic, &DepthCandidate::topic);
  if (found == candidates.end()) {
    if (candidates.size() == kMostCandidates) return;
    DepthCandidate fresh;
    fresh.topic = topic;
    fresh.type = message.connection->type;
    fresh.encoding = head.encoding;
    fresh.frame_id = head.frame_id;
    fresh.width = static_cast<int>(std::min(head.width, 65535U));
    fresh.height = static_cast<int>(std::min(head.height, 65535U));
    fresh.first = message.record_time;
    look_closely(message, fresh);
    found = candidates.insert(candidates.end(), std::move(fresh));
  }
  ++found->images;
  found->last = message.record_time;
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
    if (!is_depth_type(connection.type)) return false;
    if (!wanted.empty() && !is_same_name(connection.topic, wanted)) return false;
    const auto head = depth_head(message);
    if (!head || (wanted.empty() && head->encoding.empty())) return false;
    note_image(message, *head, candidates);
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
    const std::string what = wanted.empty()
                                 ? "it holds no depth images (16UC1, mono16 or 32FC1, also "
                                   "compressed, or organised clouds)"
                                 : fmt::format("it has no images on {}", wanted);
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
