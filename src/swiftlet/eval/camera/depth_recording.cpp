// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/depth_recording.hpp"

#include <string>
#include <utility>

#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"
#include "swiftlet/source/bag/realsense_settings.hpp"
#include "swiftlet/source/sources.hpp"
#include "swiftlet/source/text_file.hpp"

namespace swiftlet::eval {
namespace {

constexpr std::string_view kBagKind = "bag:";

/// A source of posed frames, of which the poses are dropped.
class PosedDepth final : public DepthStream {
 public:
  explicit PosedDepth(FrameSourcePtr source) : source_(std::move(source)) {}

  Expected<std::optional<DepthFrame>> next() override {
    auto frame = source_->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) return std::nullopt;
    Frame& f = **frame;
    return DepthFrame{f.stamp, std::move(f.depth), f.intrinsics, f.camera};
  }

 private:
  FrameSourcePtr source_;
};

Expected<DepthRecording> open_bag_alone(std::string_view rest) {
  auto address = parse_address(rest, "bag");
  if (!address) return forward_error(std::move(address));
  BagTopics topics;
  for (const auto& [key, value] : address->options) {
    const auto number = parse_number(value);
    if (key == "depth_topic") {
      topics.depth = value;
    } else if (key == "info_topic") {
      topics.info = value;
    } else if (key == "depth_unit_m" && number && *number > 0.0) {
      topics.depth_unit_m = *number;
    } else {
      return bad_option("bag", key, value, "depth_topic, info_topic, depth_unit_m: no poses here");
    }
  }
  auto depth = open_bag_depth(address->place, topics);
  if (!depth) return forward_error(std::move(depth));
  auto settings = read_realsense_settings(address->place, depth->topic);
  if (!settings) return forward_error(std::move(settings));
  return DepthRecording{std::move(depth->stream), depth->baseline_m, std::move(*settings)};
}

}  // namespace

Expected<DepthRecording> open_depth_recording(std::string_view address) {
  const bool is_rig = address.find(',') != std::string_view::npos;
  if (address.starts_with(kBagKind) && !is_rig)
    return open_bag_alone(address.substr(kBagKind.size()));
  auto source = open_source(address);
  if (!source) return forward_error(std::move(source));
  const auto baseline_m = (*source)->info().baseline_m;
  return DepthRecording{std::make_unique<PosedDepth>(std::move(*source)), baseline_m};
}

}  // namespace swiftlet::eval
