// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <cmath>
#include <string>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag_scan.hpp"
#include "swiftlet/source/depth_message.hpp"
#include "swiftlet/source/realsense_topics.hpp"
#include "swiftlet/source/t265_axes.hpp"
#include "swiftlet/source/text_file.hpp"

// Recordings of the RealSense SDK. A frame is several messages: its data, then its metadata as
// pairs of words, tied to it by nothing but the same record time. So a frame is complete when the
// next one of its stream begins, or the file ends.

namespace swiftlet {
namespace {

constexpr std::string_view kDepthUnits = "Depth_Units";
constexpr std::string_view kStereoBaseline = "Stereo_Baseline";  // in mm

bool is_usable_unit(std::optional<float> unit_m) {
  return unit_m && std::isfinite(*unit_m) && *unit_m > 0.0F;
}

/// The next message. A fault of the file waits in `fault` while a frame from before it is pending:
/// the stream seems to end, gives that frame, and then tells the fault.
Expected<std::optional<BagMessage>> read_after(BagReader& reader, std::optional<Error>& fault,
                                               bool is_pending) {
  if (fault && !is_pending) return tl::make_unexpected(*std::exchange(fault, std::nullopt));
  auto message = reader.next();
  if (message || !is_pending) return message;
  fault = std::move(message.error());
  return std::nullopt;
}

struct DepthSetup {
  std::string stream;  // as in "/device_0/sensor_0/Depth_0"
  std::optional<PinholeIntrinsics> intrinsics;
  float unit_m = 0.001F;
  std::optional<double> baseline_m;
};

class RealsenseDepth final : public DepthStream {
 public:
  RealsenseDepth(BagReader reader, const DepthSetup& setup)
      : reader_(std::move(reader)),
        stream_(setup.stream),
        data_topic_(setup.stream + "/image/data"),
        metadata_topic_(setup.stream + "/image/metadata"),
        intrinsics_(*setup.intrinsics),
        unit_m_(setup.unit_m) {}

  Expected<std::optional<DepthFrame>> next() override {
    while (true) {
      auto message = read();
      if (!message) return forward_error(std::move(message));
      if (!*message) return finish();
      if ((*message)->connection->topic == data_topic_) {
        auto done = finish();
        if (auto begun = begin(**message); !begun) return forward_error(std::move(begun));
        if (done) return done;
      } else {
        note(**message);
      }
    }
  }

 private:
  Expected<std::optional<BagMessage>> read() { return read_after(reader_, fault_, !!pending_); }

  struct Pending {
    Stamp record_time;
    DepthFrame frame;
    std::optional<double> frame_us, sensor_us;  // device times of read-out and mid-exposure
  };

  Status begin(const BagMessage& message) {
    const auto image = ros::parse_image(message.data);
    if (!image)
      return fail(ErrorCode::kCorruptInput, place_of(reader_, message), "it is no image message");
    const float unit_m = is_usable_unit(image->depth_unit_m) ? *image->depth_unit_m : unit_m_;
    auto depth = depth_from_message(*image, unit_m);
    if (!depth)
      return fail(ErrorCode::kCorruptInput, place_of(reader_, message), std::move(depth.error()));
    if (depth->raw.width() != intrinsics_.width() || depth->raw.height() != intrinsics_.height())
      return fail(ErrorCode::kCorruptInput, place_of(reader_, message),
                  "the image has another size than its camera_info");
    pending_.emplace(Pending{message.record_time,
                             DepthFrame{image->header.stamp, std::move(*depth), intrinsics_},
                             std::nullopt, std::nullopt});
    return Done{};
  }

  void note(const BagMessage& message) {
    const std::string& topic = message.connection->topic;
    if (topic == metadata_topic_) {
      const auto pair = ros::parse_key_value(message.data);
      if (pair && pending_ && pending_->record_time == message.record_time) note_metadata(*pair);
    } else if (is_option_of(topic, stream_, kDepthUnits)) {
      const auto unit_m = ros::parse_float32(message.data);
      if (is_usable_unit(unit_m)) unit_m_ = *unit_m;  // changed while recording
    }
  }

  void note_metadata(const ros::KeyValue& pair) {
    if (pair.key == "timestamp_domain") pending_->frame.clock = clock_from_name(pair.value);
    if (pair.key == "Frame Timestamp") pending_->frame_us = parse_number(pair.value);
    if (pair.key == "Sensor Timestamp") pending_->sensor_us = parse_number(pair.value);
  }

  std::optional<DepthFrame> finish() {
    if (!pending_) return std::nullopt;
    Pending done = *std::exchange(pending_, std::nullopt);
    if (done.frame_us && done.sensor_us) {
      // The stamp is that of the read-out; what the image shows happened in mid-exposure.
      const double late_us = *done.frame_us - *done.sensor_us;
      constexpr double kLongestExposure_us = 200'000.0;
      if (late_us > 0.0 && late_us < kLongestExposure_us)
        done.frame.stamp = done.frame.stamp - Nanoseconds(std::llround(late_us * 1e3));
    }
    return std::move(done.frame);
  }

  BagReader reader_;
  std::string stream_, data_topic_, metadata_topic_;
  PinholeIntrinsics intrinsics_;
  float unit_m_;
  std::optional<Pending> pending_;
  std::optional<Error> fault_;
};

class RealsensePoses final : public PoseStream {
 public:
  RealsensePoses(BagReader reader, const std::string& stream)
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
        const auto pose = ros::parse_transform((*message)->data);
        if (!pose)
          return fail(ErrorCode::kCorruptInput, place_of(reader_, **message),
                      "it is no pose message");
        pending_.emplace(Pending{(*message)->record_time, *pose, {}, {}, {}});
        if (done) return done;
      } else if (topic == metadata_topic_ && pending_ &&
                 pending_->record_time == (*message)->record_time) {
        if (const auto pair = ros::parse_key_value((*message)->data)) note_metadata(*pair);
      }
    }
  }

 private:
  Expected<std::optional<BagMessage>> read() { return read_after(reader_, fault_, !!pending_); }

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

  BagReader reader_;
  std::string data_topic_, metadata_topic_;
  std::optional<Pending> pending_;
  std::optional<Error> fault_;
};

/// Notes what a message before the first image tells of the camera.
Status note_setup(const BagReader& reader, const BagMessage& message, DepthSetup& setup,
                  std::string& info_stream) {
  const std::string& topic = message.connection->topic;
  constexpr std::string_view kInfo = "/info/camera_info";
  if (topic.ends_with(kInfo) && topic.find("/Depth_") != std::string::npos && !setup.intrinsics) {
    const auto info = ros::parse_camera_info(message.data);
    if (!info)
      return fail(ErrorCode::kCorruptInput, place_of(reader, message), "it is no CameraInfo");
    auto intrinsics = intrinsics_from_message(*info, place_of(reader, message));
    if (!intrinsics) return forward_error(std::move(intrinsics));
    setup.intrinsics = *intrinsics;
    info_stream = topic.substr(0, topic.size() - kInfo.size());
  }
  if (is_option_of(topic, info_stream, kDepthUnits)) {
    const auto unit_m = ros::parse_float32(message.data);
    if (is_usable_unit(unit_m)) setup.unit_m = *unit_m;
  }
  if (is_option_of(topic, info_stream, kStereoBaseline)) {
    const auto baseline_mm = ros::parse_float32(message.data);
    if (is_usable_unit(baseline_mm)) setup.baseline_m = double{*baseline_mm} * 1e-3;
  }
  return Done{};
}

bool is_realsense(const BagMessage& message) {
  return message.connection->topic.starts_with("/device_") ||
         message.connection->topic == "/file_version";
}

}  // namespace

Expected<std::optional<BagDepth>> open_realsense_depth(const std::filesystem::path& path) {
  auto reader = open_bag(path);
  if (!reader) return forward_error(std::move(reader));
  DepthSetup setup;
  std::string info_stream;
  Status noted = Done{};
  bool is_other_kind = false;
  auto found = scan_bag(*reader, [&](const BagMessage& message) {
    is_other_kind = !is_realsense(message);
    if (is_other_kind) return true;
    noted = note_setup(*reader, message, setup, info_stream);
    if (auto stream = depth_stream_of(message.connection->topic)) setup.stream = *stream;
    return !noted || !setup.stream.empty();
  });
  if (!found) return forward_error(std::move(found));
  if (is_other_kind) return std::nullopt;
  if (!noted) return forward_error(std::move(noted));
  if (setup.stream.empty())
    return no_such_topic(*reader, "it holds no depth images", "name the depth recording first");
  if (!setup.intrinsics || info_stream != setup.stream)
    return no_such_topic(*reader, "it has no camera_info before its first depth image",
                         "record it again");
  auto again = open_bag(path);
  if (!again) return forward_error(std::move(again));
  const auto intrinsics = *setup.intrinsics;
  return BagDepth{std::make_unique<RealsenseDepth>(std::move(*again), setup),
                  setup.stream + "/image/data",
                  {},
                  intrinsics,
                  setup.baseline_m};
}

Expected<std::optional<BagPoses>> open_realsense_poses(const std::filesystem::path& path) {
  auto reader = open_bag(path);
  if (!reader) return forward_error(std::move(reader));
  std::optional<std::string> stream;
  bool is_other_kind = false;
  auto found = scan_bag(*reader, [&](const BagMessage& message) {
    is_other_kind = !is_realsense(message);
    stream = pose_stream_of(message.connection->topic);
    return is_other_kind || stream.has_value();
  });
  if (!found) return forward_error(std::move(found));
  if (is_other_kind) return std::nullopt;
  if (!stream)
    return no_such_topic(*reader, "it holds no poses",
                         "the SDK writes one file a device: bag:depth.bag,pose.bag");
  auto again = open_bag(path);
  if (!again) return forward_error(std::move(again));
  return BagPoses{std::make_unique<RealsensePoses>(std::move(*again), *stream),
                  *stream + "/pose/transform/data",
                  {},
                  true};
}

}  // namespace swiftlet
