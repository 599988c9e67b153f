// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <cmath>
#include <string>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/depth_decoder.hpp"
#include "swiftlet/source/bag/depth_message.hpp"
#include "swiftlet/source/bag/realsense_messages.hpp"
#include "swiftlet/source/bag/realsense_topics.hpp"
#include "swiftlet/source/text_file.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kDepthUnits = "Depth_Units";
constexpr std::string_view kStereoBaseline = "Stereo_Baseline";  // in mm

bool is_usable_unit(std::optional<float> unit_m) {
  return unit_m && std::isfinite(*unit_m) && *unit_m > 0.0F;
}

struct DepthSetup {
  std::string stream;  // as in "/device_0/sensor_0/Depth_0"
  std::optional<PinholeIntrinsics> intrinsics;
  float unit_m = 0.001F;
  std::optional<double> baseline_m;
};

class RealsenseDepth final : public DepthStream {
 public:
  RealsenseDepth(RecordingReaderPtr reader, const DepthSetup& setup)
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
  Expected<std::optional<BagMessage>> read() { return read_after(*reader_, fault_, !!pending_); }

  struct Pending {
    Stamp record_time;
    DepthFrame frame;
    std::optional<double> frame_us, sensor_us;  // device times of read-out and mid-exposure
  };

  Status begin(const BagMessage& message) {
    auto decoded = decode_depth(message, unit_m_);
    if (!decoded)
      return fail(ErrorCode::kCorruptInput, reader_->place_of(message), std::move(decoded).error());
    DepthImage& depth = decoded->depth;
    if (depth.raw.width() != intrinsics_.width() || depth.raw.height() != intrinsics_.height())
      return fail(ErrorCode::kCorruptInput, reader_->place_of(message),
                  "the image has another size than its camera_info");
    pending_.emplace(Pending{message.record_time,
                             DepthFrame{decoded->stamp, std::move(depth), intrinsics_},
                             std::nullopt, std::nullopt});
    return Done{};
  }

  void note(const BagMessage& message) {
    const std::string& topic = message.connection->topic;
    if (topic == metadata_topic_) {
      const auto pair = ros::parse_key_value(message.serialized());
      if (pair && pending_ && pending_->record_time == message.record_time) note_metadata(*pair);
    } else if (is_option_of(topic, stream_, kDepthUnits)) {
      const auto unit_m = ros::parse_float32(message.serialized());
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

  RecordingReaderPtr reader_;
  std::string stream_, data_topic_, metadata_topic_;
  PinholeIntrinsics intrinsics_;
  float unit_m_;
  std::optional<Pending> pending_;
  std::optional<Error> fault_;
};

/// Notes what a message before the first image tells of the camera.
Status note_setup(const RecordingReader& reader, const BagMessage& message, DepthSetup& setup,
                  std::string& info_stream) {
  const std::string& topic = message.connection->topic;
  constexpr std::string_view kInfo = "/info/camera_info";
  if (topic.ends_with(kInfo) && topic.find("/Depth_") != std::string::npos && !setup.intrinsics) {
    const auto info = ros::parse_camera_info(message.serialized());
    if (!info)
      return fail(ErrorCode::kCorruptInput, reader.place_of(message), "it is no CameraInfo");
    auto intrinsics = intrinsics_from_message(*info, reader.place_of(message));
    if (!intrinsics) return forward_error(std::move(intrinsics));
    setup.intrinsics = *intrinsics;
    info_stream = topic.substr(0, topic.size() - kInfo.size());
  }
  if (is_option_of(topic, info_stream, kDepthUnits)) {
    const auto unit_m = ros::parse_float32(message.serialized());
    if (is_usable_unit(unit_m)) setup.unit_m = *unit_m;
  }
  if (is_option_of(topic, info_stream, kStereoBaseline)) {
    const auto baseline_mm = ros::parse_float32(message.serialized());
    if (is_usable_unit(baseline_mm)) setup.baseline_m = double{*baseline_mm} * 1e-3;
  }
  return Done{};
}

}  // namespace

Expected<std::optional<BagDepth>> open_realsense_depth(const std::filesystem::path& path) {
  auto reader = open_recording(path);
  if (!reader) return forward_error(std::move(reader));
  DepthSetup setup;
  std::string info_stream;
  Status noted = Done{};
  bool is_other_kind = false, is_for_ros2 = false;
  auto found = scan_bag(**reader, [&](const BagMessage& message) {
    is_other_kind = !is_realsense(message);
    is_for_ros2 = message.connection->encoding == MessageEncoding::kCdr;
    if (is_other_kind || is_for_ros2) return true;
    noted = note_setup(**reader, message, setup, info_stream);
    if (auto stream = depth_stream_of(message.connection->topic)) setup.stream = *stream;
    return !noted || !setup.stream.empty();
  });
  if (!found) return forward_error(std::move(found));
  if (is_other_kind) return std::nullopt;
  if (is_for_ros2) {
    return fail(ErrorCode::kUnsupported, (*reader)->name(),
                "it is of the RealSense SDK in messages of its own for ROS 2, which are not read",
                "record it as .bag, or by the camera's ROS 2 node");
  }
  if (!noted) return forward_error(std::move(noted));
  if (setup.stream.empty())
    return no_such_topic(**reader, "it holds no depth images", "name the depth recording first");
  if (!setup.intrinsics || info_stream != setup.stream)
    return no_such_topic(**reader, "it has no camera_info before its first depth image",
                         "record it again");
  auto again = open_recording(path);
  if (!again) return forward_error(std::move(again));
  const auto intrinsics = *setup.intrinsics;
  return BagDepth{std::make_unique<RealsenseDepth>(std::move(*again), setup),
                  setup.stream + "/image/data",
                  {},
                  intrinsics,
                  setup.baseline_m,
                  "depth from " + setup.stream + "/image/data"};
}

}  // namespace swiftlet
