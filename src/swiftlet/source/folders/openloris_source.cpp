// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/depth_png.hpp"
#include "swiftlet/source/folders/folder_camera.hpp"
#include "swiftlet/source/folders/folder_options.hpp"
#include "swiftlet/source/folders/openloris_calibration.hpp"
#include "swiftlet/source/folders/tum_lists.hpp"
#include "swiftlet/source/rig/joined_source.hpp"
#include "swiftlet/source/rig/rig_options.hpp"

// OpenLORIS-Scene: a robot with a D435i and a T265 in homes, offices and markets. Its released
// folders hold no pose stream of the T265, only the ground truth of the robot's base_link; a path
// of your own odometry can take its place. Options: images=depth|aligned_depth, poses=FILE (lines
// as in groundtruth.txt), depth_unit_m, time_offset_ms, and those of every rig. Source: Shi et al.
// 2020; lifelong-robotic-vision/openloris-scene-tools.

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOpenlorisContent =
    "depth.txt, groundtruth.txt, sensors.yaml, trans_matrix.yaml and the images they speak of";
constexpr double kBaseline_m = 0.05;  // D435i

class ListedDepth final : public DepthStream {
 public:
  ListedDepth(fs::path folder, std::vector<TumImage> images, const PinholeIntrinsics& intrinsics,
              const DepthPngFormat& format)
      : folder_(std::move(folder)),
        images_(std::move(images)),
        intrinsics_(intrinsics),
        format_(format) {}

  /// The next image that can be used.
  Expected<std::optional<DepthFrame>> next() override {
    while (next_ < images_.size()) {
      const TumImage& image = images_[next_++];
      auto depth = read(folder_ / image.file);
      if (depth) return DepthFrame{image.stamp, std::move(*depth), intrinsics_};
      skipped_.push_back({loss_of_image(depth.error()), std::move(depth).error()});
    }
    return std::nullopt;
  }
  std::vector<SkippedImage> take_skipped() override { return std::exchange(skipped_, {}); }

 private:
  [[nodiscard]] Expected<DepthImage> read(const fs::path& file) const {
    auto depth = read_depth_png(file, format_);
    if (!depth) return depth;
    if (depth->raw.width() != intrinsics_.width() || depth->raw.height() != intrinsics_.height())
      return fail(ErrorCode::kCorruptInput, file.string(),
                  "the image has another size than sensors.yaml tells");
    return depth;
  }

  fs::path folder_;
  std::vector<TumImage> images_;
  PinholeIntrinsics intrinsics_;
  DepthPngFormat format_;
  std::vector<SkippedImage> skipped_;
  std::size_t next_ = 0;
};

class ListedPoses final : public PoseStream {
 public:
  explicit ListedPoses(std::vector<TumPose> poses) : poses_(std::move(poses)) {}

  /// The file tells where base_link is, in a world with z up: ours.
  Expected<std::optional<PoseSample>> next() override {
    if (next_ == poses_.size()) return std::nullopt;
    const TumPose& pose = poses_[next_++];
    return PoseSample{pose.stamp, pose.R_native_camera, pose.t_native_camera_m};
  }

 private:
  std::vector<TumPose> poses_;
  std::size_t next_ = 0;
};

/// The lists have the format of TUM's, but the folder is another.
template <class List>
Expected<List> of_this_kind(Expected<List> list) {
  if (!list && list.error().code == ErrorCode::kNotFound)
    list.error().remedy = fmt::format("the folder should hold {}", kOpenlorisContent);
  return list;
}

struct Request {
  std::string images = "depth";
  std::string poses;  // empty: the ground truth
  RigOptions rig;
  FolderOptions folder;
};

Expected<Request> parse_request(const SourceAddress& address) {
  Request request;
  for (const auto& [key, value] : address.options) {
    const bool is_images = key == "images" && (value == "depth" || value == "aligned_depth");
    if (is_images) request.images = value;
    if (key == "poses") request.poses = value;
    const bool is_own = is_images || (key == "poses" && !value.empty()) ||
                        apply_depth_unit(key, value, request.folder) ||
                        apply_time_offset(key, value, request.folder);
    if (!is_own && (key == "rig" || !apply_rig_option(key, value, request.rig)))
      return bad_option(
          "openloris", key, value,
          "images=depth|aligned_depth, poses=FILE, depth_unit_m, time_offset_ms, pairing, "
          "on_jump, pose_offset_ms");
  }
  const auto on_jump = request.rig.poses.gates.on_jump;
  request.rig.poses.gates = request.poses.empty() ? PoseGates::open() : tracker_gates();
  request.rig.poses.gates.on_jump = on_jump;
  return request;
}

}  // namespace

Expected<FrameSourcePtr> open_openloris_source(std::string_view rest) {
  auto address = parse_place_address(rest, "openloris");
  if (!address) return forward_error(std::move(address));
  auto request = parse_request(*address);
  if (!request) return forward_error(std::move(request));
  const fs::path folder(address->place);
  if (auto usable = check_folder(folder, kOpenlorisContent); !usable)
    return forward_error(std::move(usable));

  const bool is_aligned = request->images == "aligned_depth";  // to the colour camera
  auto camera = read_openloris_camera(
      folder, is_aligned ? "d400_color_optical_frame" : "d400_depth_optical_frame");
  if (!camera) return forward_error(std::move(camera));
  auto images = of_this_kind(read_tum_images(folder / (request->images + ".txt")));
  if (!images) return forward_error(std::move(images));
  shift_times(*images, request->folder.time_offset);
  auto poses = of_this_kind(read_tum_poses(request->poses.empty() ? folder / "groundtruth.txt"
                                                                  : fs::path(request->poses)));
  if (!poses) return forward_error(std::move(poses));

  request->rig.cameras.front().T_body_camera = camera->T_body_camera;
  const DepthPngFormat format{.unit_m = request->folder.depth_unit_m.value_or(0.001F)};
  SourceInfo info{.uri = "openloris:" + std::string(rest),
                  .native_up_axis = "+z",
                  .frame_count = images->size(),
                  .baseline_m = kBaseline_m,
                  .intrinsics = {IntrinsicsOrigin::kFile, (folder / "sensors.yaml").string()}};
  if (!request->folder.depth_unit_m) info.assumed_depth_unit_m = format.unit_m;
  std::vector<DepthStreamPtr> streams;
  streams.push_back(
      std::make_unique<ListedDepth>(folder, std::move(*images), camera->intrinsics, format));
  return std::make_unique<JoinedSource>(std::move(info), std::move(streams),
                                        std::make_unique<ListedPoses>(std::move(*poses)),
                                        request->rig);
}

}  // namespace swiftlet
