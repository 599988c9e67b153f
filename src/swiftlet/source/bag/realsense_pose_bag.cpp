// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <string>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/realsense_messages.hpp"
#include "swiftlet/source/bag/realsense_topics.hpp"
#include "swiftlet/source/rig/t265_axes.hpp"
#include "swiftlet/source/text_file.hpp"

namespace swiftlet {
namespace {

class RealsensePoses final : public PoseStream {
 public:
  RealsensePoses(RecordingReaderPtr reader, const std::string& stream)
      : reader_(std::move(reader)),
        data_topic_(stream + "/pose/transform/data"),
        metadata_topic_(stream + "/pose/metadata") {}

  Expected<std::optional<PoseSample>> next() override {
    while (true) {
      auto message = read();
      if (!message) return forward_error(std::move(message));
      if (!*message) return finish();
      const std::string& topic = (*message)->connection->topic;
      if (topic == data_topic_) {
        auto done = finish();
        const auto pose = ros::parse_transform((*message)->serialized());
        if (!pose)
          return fail(ErrorCode::kCorruptInput, reader_->place_of(**message),
                      "it is no pose message");
        pending_.emplace(Pending{(*message)->record_time, *pose, {}, {}, {}});
        if (done) return done;
      } else if (topic == metadata_topic_ && pending_ &&
                 pending_->record_time == (*message)->record_time) {
        if (const auto pair = ros::parse_key_value((*message)->serialized())) note_metadata(*pair);
      }
    }
  }

 private:
  Expected<std::optional<BagMessage>> read() { return read_after(*reader_, fault_, !!pending_); }

  struct Pending {
    Stamp record_time;
    ros::Pose pose;
    std::optional<Stamp> stamp;
    std::uint8_t confidence = 0;
    ClockDomain clock = ClockDomain::kUnspecified;
  };

  void note_metadata(const ros::KeyValue& pair) {
    if (pair.key == "frame_timestamp") pending_->stamp = stamp_from_milliseconds(pair.value);
    if (pair.key == "timestamp_domain") pending_->clock = clock_from_name(pair.value);
    if (pair.key == "Tracker Confidence") {
      const double confidence = parse_number(pair.value).value_or(0.0);
      pending_->confidence =
          confidence >= 1.0 && confidence <= 3.0 ? static_cast<std::uint8_t>(confidence) : 0;
    }
  }

  /// A pose without a time, as the last one of a file that was cut off, is of no use to anyone.
  std::optional<PoseSample> finish() {
    const auto done = std::exchange(pending_, std::nullopt);
    if (!done || !done->stamp) return std::nullopt;
    PoseSample sample = from_t265(*done->stamp, done->pose.R, done->pose.t_m, done->confidence);
    sample.clock = done->clock;
    return sample;
  }

  RecordingReaderPtr reader_;
  std::string data_topic_, metadata_topic_;
  std::optional<Pending> pending_;
  std::optional<Error> fault_;
};

}  // namespace

Expected<std::optional<BagPoses>> open_realsense_poses(const std::filesystem::path& path) {
  auto reader = open_recording(path);
  if (!reader) return forward_error(std::move(reader));
  std::optional<std::string> stream;
  bool is_other_kind = false;
  auto found = scan_bag(**reader, [&](const BagMessage& message) {
    is_other_kind = !is_realsense(message);
    stream = pose_stream_of(message.connection->topic);
    return is_other_kind || stream.has_value();
  });
  if (!found) return forward_error(std::move(found));
  if (is_other_kind) return std::nullopt;
  if (!stream)
    return no_such_topic(**reader, "it holds no poses",
                         "the SDK writes one file a device: bag:depth.bag,pose.bag");
  auto again = open_recording(path);
  if (!again) return forward_error(std::move(again));
  return BagPoses{std::make_unique<RealsensePoses>(std::move(*again), *stream),
                  *stream + "/pose/transform/data",
                  {},
                  true,
                  "poses from " + *stream + "/pose/transform/data"};
}

}  // namespace swiftlet
