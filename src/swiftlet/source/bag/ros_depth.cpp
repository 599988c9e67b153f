// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/bag_survey.hpp"
#include "swiftlet/source/bag/depth_decoder.hpp"
#include "swiftlet/source/bag/depth_message.hpp"

// The depth images of recordings of ROS, as of realsense-ros or OpenLORIS-Scene.

namespace swiftlet {
namespace {

constexpr std::string_view kInfoType = "sensor_msgs/CameraInfo";

/// What the CameraInfo messages of a camera have told, each time it was something new.
class InfoHistory {
 public:
  void note(const ros::CameraInfo& info) {
    if (!history_.empty() && history_.back().is_same_camera(info)) return;
    if (history_.size() == kMost) history_.erase(history_.begin());
    history_.push_back(info);
    history_.back().header.frame_id = {};  // a view into the message
    history_.back().distortion_model = {};
  }
  /// What held at a time: the newest of then; of the time before all, the first.
  [[nodiscard]] const ros::CameraInfo& at(Stamp stamp) const {
    const auto newest_by_then =
        std::find_if(history_.rbegin(), history_.rend(),
                     [&](const ros::CameraInfo& info) { return info.header.stamp <= stamp; });
    return newest_by_then == history_.rend() ? history_.front() : *newest_by_then;
  }
  [[nodiscard]] Stamp newest() const { return history_.back().header.stamp; }

 private:
  static constexpr std::size_t kMost = 64;
  std::vector<ros::CameraInfo> history_;
};

class RosDepth final : public DepthStream {
 public:
  RosDepth(RecordingReaderPtr reader, std::string topic, std::string info_topic,
           const ros::CameraInfo& first, float unit_m)
      : reader_(std::move(reader)),
        topic_(std::move(topic)),
        info_topic_(std::move(info_topic)),
        unit_m_(unit_m) {
    infos_.note(first);
  }

  /// An image is pending until the next one, because its CameraInfo may follow it.
  Expected<std::optional<DepthFrame>> next() override {
    while (true) {
      auto message = read_after(*reader_, fault_, pending_.has_value());
      if (!message) return forward_error(std::move(message));
      if (!*message) return finish();
      if ((*message)->connection->topic == topic_) {
        auto done = finish();
        if (!done) return done;
        begin(**message);
        if (*done) return done;
      } else if ((*message)->connection->topic == info_topic_) {
        note_info(**message);
        if (pending_ && infos_.newest() == pending_->stamp) return finish();
      }
    }
  }

  std::vector<SkippedImage> take_skipped() override { return std::exchange(skipped_, {}); }

 private:
  struct Pending {
    Stamp stamp;
    DepthImage depth;
    std::string place;
  };

  /// One that is no image is left out: it must not cost the others.
  void begin(const BagMessage& message) {
    auto decoded = decode_depth(message, unit_m_);
    if (!decoded) {
      skipped_.push_back(
          {FrameLoss::kImageUnreadable,
           {ErrorCode::kCorruptInput, reader_->place_of(message), std::move(decoded).error(), {}}});
      return;
    }
    pending_.emplace(
        Pending{decoded->stamp, std::move(decoded->depth), reader_->place_of(message)});
  }

  /// One that cannot be meant, as a driver sends that is not calibrated, changes nothing.
  void note_info(const BagMessage& message) {
    const auto info = ros::parse_camera_info(message.serialized());
    if (info && info->K[0] > 0.0) infos_.note(*info);
  }

  Expected<std::optional<DepthFrame>> finish() {
    if (!pending_) return std::nullopt;
    Pending done = *std::exchange(pending_, std::nullopt);
    auto intrinsics = intrinsics_of_images(infos_.at(done.stamp), done.depth.raw.width(),
                                           done.depth.raw.height(), done.place);
    if (!intrinsics) return forward_error(std::move(intrinsics));
    return DepthFrame{done.stamp, std::move(done.depth), *intrinsics};
  }

  RecordingReaderPtr reader_;
  std::string topic_, info_topic_;
  InfoHistory infos_;
  float unit_m_;
  std::optional<Pending> pending_;
  std::optional<Error> fault_;
  std::vector<SkippedImage> skipped_;
};

struct FoundInfo {
  std::string topic;
  ros::CameraInfo info;
  PinholeIntrinsics intrinsics;
};

/// A cloud tells its camera by its points.
Expected<FoundInfo> info_of_images(const RecordingReader& reader, const std::string& topic,
                                   const DepthCandidate& images) {
  if (!images.camera) {
    return no_such_topic(reader, "it has no CameraInfo on " + topic,
                         "choose a topic with --info-topic", topic);
  }
  auto intrinsics =
      intrinsics_of_images(*images.camera, images.width, images.height, reader.name());
  if (!intrinsics) return forward_error(std::move(intrinsics));
  return FoundInfo{"the points", *images.camera, *intrinsics};
}

Expected<FoundInfo> find_info(RecordingReader& reader, const std::string& topic,
                              const DepthCandidate& images) {
  Expected<FoundInfo> found = tl::make_unexpected(Error{});
  bool is_unusable = false;
  auto is_found = scan_bag(reader, [&](const BagMessage& message) {
    if (message.connection->type != kInfoType || !is_same_name(message.connection->topic, topic))
      return false;
    const auto info = ros::parse_camera_info(message.serialized());
    const std::string place = reader.place_of(message);
    // One that cannot be meant, as before a driver is calibrated, is followed by others.
    if (!info || !(info->K[0] > 0.0)) {
      found = fail(ErrorCode::kCorruptInput, place,
                   info ? "its CameraInfo has no focal length" : "it is no CameraInfo",
                   "choose a topic with --info-topic");
      is_unusable = true;
      return false;
    }
    auto intrinsics = intrinsics_of_images(*info, images.width, images.height, place);
    if (!intrinsics) {
      found = forward_error(std::move(intrinsics));
      return true;
    }
    found = FoundInfo{message.connection->topic, *info, *intrinsics};
    found->info.header.frame_id = {};  // views into the message
    found->info.distortion_model = {};
    return true;
  });
  if (!is_found) return forward_error(std::move(is_found));
  if (*is_found || (is_unusable && !images.camera)) return found;
  return info_of_images(reader, topic, images);
}

std::string told(const DepthCandidate& chosen, const std::vector<DepthCandidate>& candidates,
                 const std::string& info_topic) {
  std::string others;
  for (const DepthCandidate& candidate : candidates) {
    if (candidate.topic != chosen.topic)
      others += (others.empty() ? "; not from " : ", ") + candidate.text();
  }
  return fmt::format("depth from {}, intrinsics from {}{}", chosen.text(), info_topic, others);
}

}  // namespace

Expected<BagDepth> open_ros_depth(const std::filesystem::path& path, const BagTopics& topics) {
  auto first = open_recording(path);
  if (!first) return forward_error(std::move(first));
  auto candidates = survey_depth(**first, topics.depth);
  if (!candidates) return forward_error(std::move(candidates));
  auto images = choose_depth(**first, *candidates, topics.depth);
  if (!images) return forward_error(std::move(images));

  auto second = open_recording(path);
  if (!second) return forward_error(std::move(second));
  const std::string beside = camera_info_beside(images->topic);
  auto info = find_info(**second, topics.info.empty() ? beside : topics.info, *images);
  if (!info) return forward_error(std::move(info));

  auto third = open_recording(path);
  if (!third) return forward_error(std::move(third));
  return BagDepth{std::make_unique<RosDepth>(std::move(*third), images->topic, info->topic,
                                             info->info, static_cast<float>(topics.depth_unit_m)),
                  images->topic,
                  images->frame_id,
                  info->intrinsics,
                  std::nullopt,
                  told(*images, *candidates, info->topic)};
}

}  // namespace swiftlet
