// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/flight/flight_recording.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "swiftlet/bag/byte_sink.hpp"
#include "swiftlet/bag/messages/message_definitions.hpp"
#include "swiftlet/base/narrow.hpp"
#include "swiftlet/base/start_thread.hpp"
#include "swiftlet/station/foxglove/foxglove_messages.hpp"
#include "swiftlet/station/foxglove/foxglove_parts.hpp"
#include "swiftlet/station/station.hpp"

namespace swiftlet::station {
namespace {

constexpr std::size_t kMostFrames = 8;  // that wait
constexpr std::size_t kMostPoses = 2000;
constexpr Nanoseconds kMapEvery = std::chrono::seconds(1);
constexpr float kMillimetre = 0.001F;

std::string camera_name(std::uint8_t camera) {
  return camera == 0 ? "camera" : "camera" + std::to_string(int{camera} + 1);
}

ros2::Placement placement_of(const Transform<World, Camera>& T) {
  return {T.translation(), T.rotation()};
}

/// In the unit that ROS has for 16-bit images, if it is ours; else in metres.
Bytes depth_message(const ros2::Header& header, const DepthImage& depth) {
  const auto width = to<std::uint32_t>(depth.raw.width());
  const auto height = to<std::uint32_t>(depth.raw.height());
  if (depth.unit_m == kMillimetre)
    return ros2::depth_image(header, width, height, depth.raw.pixels());
  std::vector<float> metres(depth.raw.pixels().size());
  std::ranges::transform(depth.raw.pixels(), metres.begin(), [&](std::uint16_t d) {
    return d == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(d) * depth.unit_m;
  });
  return ros2::depth_image(header, width, height, std::span<const float>(metres));
}

/// "sensor_msgs/Image" is "sensor_msgs/msg/Image" to ROS 2.
std::string full_type_name(std::string_view type) {
  std::string name(type);
  return name.insert(name.find('/'), "/msg");
}

}  // namespace

FlightRecording::FlightRecording(LiveFeed& feed, McapWriter writer)
    : writer_(std::move(writer)), model_(feed) {}

Expected<std::unique_ptr<FlightRecording>> FlightRecording::start(
    const std::filesystem::path& path, LiveFeed& feed, const McapWriter::Metadata& words) {
  auto sink = open_file_sink(path);
  if (!sink) return forward_error(std::move(sink));
  auto writer = McapWriter::create(std::move(*sink), {});
  if (!writer) return forward_error(std::move(writer));
  if (auto written = writer->write_metadata("swiftlet flight", words); !written)
    return forward_error(std::move(written));
  std::unique_ptr<FlightRecording> recording(new FlightRecording(feed, std::move(*writer)));
  auto thread = start_thread(path.string(), [&self = *recording] {
    run_with_low_priority();
    self.run();
  });
  if (!thread) return forward_error(std::move(thread));
  recording->thread_ = std::move(*thread);
  return recording;
}

FlightRecording::~FlightRecording() { (void)close(); }

void FlightRecording::add(const Frame& frame) {
  const bool is_live = frame.seen_at.has_value();
  std::unique_lock lock(mutex_);
  if (!is_live) has_changed_.wait(lock, [&] { return frames_.size() < kMostFrames; });
  if (frames_.size() < kMostFrames) {
    frames_.push_back(frame);
  } else {
    ++missed_;
  }
  lock.unlock();
  has_changed_.notify_all();
}

Status FlightRecording::close() {
  if (!thread_.joinable()) return outcome_;
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
  }
  has_changed_.notify_all();
  thread_.join();
  return outcome_;
}

std::deque<Frame> FlightRecording::take_frames() {
  constexpr auto kLook = std::chrono::milliseconds(50);  // as often as the feed must be emptied
  std::unique_lock lock(mutex_);
  has_changed_.wait_for(lock, kLook, [&] { return is_closing_ || !frames_.empty(); });
  std::deque<Frame> taken = std::exchange(frames_, {});
  lock.unlock();
  has_changed_.notify_all();
  return taken;
}

bool FlightRecording::is_finished() {
  const std::lock_guard lock(mutex_);
  return is_closing_ && frames_.empty();
}

void FlightRecording::poll_map() {
  const MapModel::Update update = model_.poll();
  if (update.is_new_world) changed_.clear();  // they were of the map before
  std::ranges::copy(update.changed, std::back_inserter(changed_));
}

/// After a fault frames are still taken, so that nobody waits for ever.
void FlightRecording::run() {
  while (!is_finished()) {
    std::deque<Frame> frames = take_frames();
    poll_map();
    if (outcome_) outcome_ = write_all(std::move(frames));
  }
  if (outcome_ && newest_) outcome_ = write_map();
  if (outcome_) outcome_ = writer_.close();
}

Status FlightRecording::write_all(std::deque<Frame>&& frames) {
  for (const Frame& frame : frames) {
    if (auto written = write_frame(frame); !written) return written;
    newest_ = std::max(newest_.value_or(frame.stamp), frame.stamp);
  }
  if (!newest_ || (map_written_ && *newest_ - *map_written_ < kMapEvery)) return Done{};
  return write_map();
}

Status FlightRecording::write(std::string_view topic, std::string_view type, Stamp time,
                              const Bytes& message) {
  auto place = topics_.find(topic);
  if (place == topics_.end()) {
    const std::uint16_t number = type.empty()
                                     ? writer_.add_topic(topic, "swiftlet.Statistics", "jsonschema",
                                                         R"({"type":"object"})", "json")
                                     : writer_.add_topic(topic, full_type_name(type), "ros2msg",
                                                         message_definition(type), "cdr");
    place = topics_.emplace(topic, number).first;
  }
  return writer_.write(place->second, std::max(time, Stamp{0}), message);
}

Status FlightRecording::write_frame(const Frame& frame) {
  const std::string camera = camera_name(frame.camera);
  const std::string images = "/" + camera + "/depth";
  const ros2::Header seen{frame.stamp, camera}, placed{frame.stamp, kMapFrame};
  const ros2::Placement pose = placement_of(frame.T_world_camera);
  const PinholeIntrinsics& K = frame.intrinsics;
  const auto width = to<std::uint32_t>(K.width()), height = to<std::uint32_t>(K.height());
  if (std::exchange(epoch_, frame.pose_epoch) != frame.pose_epoch) path_.clear();
  if (frame.camera == 0) note_path(pose);
  auto written =
      write("/tf", "tf2_msgs/TFMessage", frame.stamp, ros2::transform(placed, camera, pose));
  if (written)
    written = write("/" + camera + "/odometry", "nav_msgs/Odometry", frame.stamp,
                    ros2::odometry(placed, camera, pose));
  if (written)
    written = write(images + "/camera_info", "sensor_msgs/CameraInfo", frame.stamp,
                    ros2::camera_info(seen, width, height, K.fx(), K.fy(), K.cx(), K.cy()));
  if (written)
    written = write(images + "/image_rect_raw", "sensor_msgs/Image", frame.stamp,
                    depth_message(seen, frame.depth));
  return written;
}

/// Every pose at first; as there are more, every second, every fourth ...
void FlightRecording::note_path(const ros2::Placement& placement) {
  if (path_seen_++ % path_every_ != 0) return;
  path_.push_back(placement);
  if (path_.size() < kMostPoses) return;
  for (std::size_t i = 0; 2 * i < path_.size(); ++i) path_[i] = path_[2 * i];
  path_.resize(path_.size() / 2);
  path_every_ *= 2;
}

Status FlightRecording::write_voxels(Stamp now) {
  const double voxel_m = model_.map().voxel_m();
  const LogOddsScale& scale = model_.map().scale();
  constexpr double kFloatReaches_m = 1e4;
  const bool is_far =
      model_.last_frame() &&
      model_.last_frame()->T_world_camera.translation().cwiseAbs().maxCoeff() > kFloatReaches_m;
  ros2::VoxelCloud occupied("log_odds", is_far), changes("log_odds", is_far);
  const auto add = [&](ros2::VoxelCloud& cloud, const BlockIndex& index, const VoxelBlock& block,
                       bool with_free) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const QuantizedLogOdds voxel = block.voxels[static_cast<std::size_t>(i)];
      const Occupancy state = scale.classify(voxel);
      if (state == Occupancy::kOccupied || (with_free && state == Occupancy::kFree))
        cloud.add(centre_of(voxel_at(index, i), voxel_m), voxel);
    }
  };
  model_.map().for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    add(occupied, index, block, false);
  });
  std::ranges::sort(changed_, {}, [](const BlockIndex& b) { return std::array{b.x, b.y, b.z}; });
  changed_.erase(std::ranges::unique(changed_).begin(), changed_.end());
  for (const BlockIndex& index : changed_) {
    if (const VoxelBlock* block = model_.map().find(index)) add(changes, index, *block, true);
  }
  changed_.clear();
  const ros2::Header header{now, kMapFrame};
  auto written = write("/map/occupied", "sensor_msgs/PointCloud2", now, occupied.message(header));
  if (written)
    written = write("/map/changes", "sensor_msgs/PointCloud2", now, changes.message(header));
  return written;
}

Status FlightRecording::write_map() {
  const Stamp now = *newest_;
  map_written_ = now;
  poll_map();
  if (model_.world() == 0) return Done{};
  if (auto written = write_voxels(now); !written) return written;
  if (auto written = write("/path", "nav_msgs/Path", now, ros2::path({now, kMapFrame}, path_));
      !written)
    return written;
  for (const FoxgloveChannel& channel : foxglove_channels()) {
    if (channel.topic != "/vehicle" && channel.topic != "/statistics") continue;
    const Bytes message = channel.message(model_);
    if (message.empty()) continue;
    if (auto written = write(channel.topic, channel.schema, now, message); !written) return written;
  }
  return Done{};
}

}  // namespace swiftlet::station
