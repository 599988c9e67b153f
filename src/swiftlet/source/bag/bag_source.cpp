// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/bag/bag_streams.hpp"
#include "swiftlet/source/rig/joined_source.hpp"
#include "swiftlet/source/rig/rig_options.hpp"
#include "swiftlet/source/rig/world_axes.hpp"

// bag:FILE[,FILE...][?option=value&...]: recordings of the RealSense SDK and of ROS
// (docs/rig.md). One file holds images and poses; of several, the last holds the poses.

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBagOptions =
    "depth_topic, info_topic, pose_topic, body_frame, world_frame, pose_axes=rep103|t265|optical, "
    "depth_unit_m";

struct BagRequest {
  std::vector<std::string> depth_files;
  std::string pose_file;
  BagTopics topics;
  RigDescription rig = intel_t265_d435_rig();
  bool has_rig_file = false;
};

/// false if the option is not known or cannot be meant.
bool apply(std::string_view key, const std::string& value, BagRequest& request) {
  if (key == "depth_topic") return !(request.topics.depth = value).empty();
  if (key == "info_topic") return !(request.topics.info = value).empty();
  if (key == "pose_topic") return !(request.topics.pose = value).empty();
  if (key == "body_frame") return !(request.topics.body_frame = value).empty();
  if (key == "world_frame") return !(request.topics.world_frame = value).empty();
  if (key == "pose_axes") {
    const auto axes = body_axes_from(value);
    request.topics.pose_axes = axes.value_or(BodyAxes::kRep103);
    return axes.has_value();
  }
  if (key == "depth_unit_m") {
    const auto unit_m = number_within(value, 1e-6, 0.1);
    request.topics.depth_unit_m = unit_m.value_or(0.001);
    return unit_m.has_value();
  }
  return apply_rig_option(key, value, request.rig.rig);
}

std::vector<std::string> split_files(const std::string& place) {
  std::error_code unreadable;
  if (fs::exists(place, unreadable)) return {place};  // its name may hold a comma
  return split_list(place);
}

Status assign_files(const std::string& place, BagRequest& request) {
  std::vector<std::string> files = split_files(place);
  if (std::ranges::find(files, std::string()) != files.end())
    return fail(ErrorCode::kUsage, "bag", "no file is named", "write bag:depth.bag,pose.bag");
  request.pose_file = files.back();
  if (files.size() > 1) files.pop_back();
  const std::size_t cameras = request.rig.rig.cameras.size();
  if (files.size() == 1) files.resize(cameras, files.front());
  if (files.size() != cameras)
    return fail(ErrorCode::kUsage, "bag",
                fmt::format("{} files with depth for {} cameras", files.size(), cameras),
                "describe the cameras in a rig file, one a file (docs/rig.md)");
  request.depth_files = std::move(files);
  return Done{};
}

Expected<BagRequest> parse_request(std::string_view rest) {
  auto address = parse_address(rest, "bag");
  if (!address) return forward_error(std::move(address));
  BagRequest request;
  auto rig = rig_of(*address);
  if (!rig) return forward_error(std::move(rig));
  if (*rig) {
    request.rig = std::move(**rig);
    request.has_rig_file = true;
    request.topics.pose = request.rig.pose_stream;
    request.topics.body_frame = request.rig.body_frame;
    request.topics.pose_axes = request.rig.pose_axes;
  }
  for (const auto& [key, value] : address->options) {
    if (!apply(key, value, request))
      return bad_option("bag", key, value, fmt::format("{}, {}", kRigOptions, kBagOptions));
  }
  if (auto assigned = assign_files(address->place, request); !assigned)
    return forward_error(std::move(assigned));
  return request;
}

/// A ROS bag may tell its own mount; the SDK's recordings never do, as they are one device each.
Status find_mount(const std::string& camera_frame, const BagPoses& poses, BagRequest& request) {
  if (request.has_rig_file || poses.is_t265) return Done{};
  const std::string& file = request.depth_files.front();
  if (camera_frame.empty() || poses.child_frame.empty()) {
    return fail(ErrorCode::kNotFound, file,
                "nobody tells where the camera sits on what has the poses",
                "describe the mount in a rig file and give it with --rig (docs/rig.md)");
  }
  auto mount = mount_from_tf(file, poses.child_frame, camera_frame);
  if (!mount) return forward_error(std::move(mount));
  request.rig.rig.cameras.front().T_body_camera = *mount;
  return Done{};
}

}  // namespace

Expected<FrameSourcePtr> open_bag_source(std::string_view rest) {
  auto request = parse_request(rest);
  if (!request) return forward_error(std::move(request));
  RigOptions& rig = request->rig.rig;

  std::vector<DepthStreamPtr> streams;
  SourceInfo info{"bag:" + std::string(rest), "+z", std::nullopt, std::nullopt};
  std::string camera_frame;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    BagTopics topics = request->topics;
    if (!rig.cameras[i].stream.empty()) topics.depth = rig.cameras[i].stream;
    auto depth = open_bag_depth(request->depth_files[i], topics);
    if (!depth) return forward_error(std::move(depth));
    if (i == 0) {
      info.baseline_m = depth->baseline_m;
      info.intrinsics = {IntrinsicsOrigin::kCameraInfo, "of " + depth->topic};
      camera_frame = depth->frame_id;
    }
    if (rig.cameras.size() > 1 && rig.cameras[i].baseline_m == 0.0)
      rig.cameras[i].baseline_m = depth->baseline_m.value_or(0.0);
    info.choices.push_back(depth->told);
    streams.push_back(std::move(depth->stream));
  }
  // A rig file tells the mount on its own vehicle, which need not be what moves in tf.
  if (!request->has_rig_file) request->topics.camera_frame = camera_frame;
  auto poses = open_bag_poses(request->pose_file, request->topics);
  if (!poses) return forward_error(std::move(poses));
  if (auto mounted = find_mount(camera_frame, *poses, *request); !mounted)
    return forward_error(std::move(mounted));
  if (poses->is_t265) info.native_up_axis = "+y";
  info.choices.push_back(poses->told);
  return std::make_unique<JoinedSource>(std::move(info), std::move(streams),
                                        std::move(poses->stream), rig);
}

}  // namespace swiftlet
