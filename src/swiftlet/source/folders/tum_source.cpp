// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/source/folders/folder_camera.hpp"
#include "swiftlet/source/folders/folder_options.hpp"
#include "swiftlet/source/folders/tum_lists.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/world_axes.hpp"
#include "swiftlet/source/skipped_records.hpp"

// TUM RGB-D: depth.txt lists 16-bit images (5000 steps a metre, 0 = no reading), groundtruth.txt
// the path of the camera; each with its own clock ticks. The pose of an image is interpolated at
// the image's own time, not taken from the nearest neighbour. Images and poses that are bad are
// left out and counted. Options: folder_options.hpp. Source: Sturm et al. 2012 and the data set's
// pages "File Formats", "Intrinsic Camera Calibration".

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTumContent = "depth.txt, groundtruth.txt and the images they list";
// Full scale, 13.1 m, is beyond any Kinect: a clipped value, not a reading.
constexpr DepthPngFormat kTumFormat{.unit_m = 1.0F / 5000.0F, .is_full_scale_invalid = true};
constexpr double kTumBaseline_m = 0.075;
constexpr WorldAxes kTumAxes = WorldAxes::kZUp;  // motion capture

// The calibrations of the data set's depth images, which are registered to colour.
constexpr std::array kTumCameras{KnownCamera{"TUM freiburg1", 517.3, 516.5, 318.6, 255.3},
                                 KnownCamera{"TUM freiburg2", 520.9, 521.0, 325.1, 249.7},
                                 KnownCamera{"TUM freiburg3", 535.4, 539.2, 320.1, 247.6}};

/// The camera that a name speaks of: freiburg1, 2 or 3, also fr1, 2 or 3, as a word of it.
std::optional<KnownCamera> camera_named(std::string_view name) {
  const auto is_part_of_word = [&](std::size_t at) {
    return at < name.size() && name.find_first_of("_-. '/", at) != at;
  };
  for (const std::string_view mark : {"freiburg", "fr"}) {
    for (std::size_t at = name.find(mark); at != std::string_view::npos;
         at = name.find(mark, at + 1)) {
      const std::size_t digit = at + mark.size();
      const bool is_word = (at == 0 || !is_part_of_word(at - 1)) && !is_part_of_word(digit + 1);
      if (!is_word || digit >= name.size() || name[digit] < '1' || name[digit] > '3') continue;
      return kTumCameras[static_cast<std::size_t>(name[digit] - '1')];
    }
  }
  return std::nullopt;
}

/// Recognises a recording of the data set: its lists name the bag that they were made from, as in
/// 'rgbd_dataset_freiburg1_xyz.bag'; where the heads of the lists are gone, its folder does.
void recognise(FolderCameraRequest& request) {
  request.recognised_by = "the head of depth.txt";
  request.known = camera_named(tum_origin(request.folder / "depth.txt"));
  if (request.known) return;
  std::error_code refused;
  const fs::path real = fs::canonical(request.folder, refused);  // "." and "dir/" have a name, too
  request.recognised_by = "the name of the folder";
  request.known = camera_named((refused ? request.folder : real).filename().string());
}

Status check_overlap(const fs::path& folder, const std::vector<TumImage>& images,
                     const std::vector<TumPose>& poses) {
  const Stamp from = std::max(images.front().stamp, poses.front().stamp);
  const Stamp until = std::min(images.back().stamp, poses.back().stamp);
  if (from <= until) return Done{};
  const auto s = [](Stamp stamp) { return seconds(Nanoseconds(stamp.ns)); };
  return fail(ErrorCode::kCorruptInput, folder.string(),
              fmt::format("depth ({:.3f} to {:.3f} s) and ground truth ({:.3f} to {:.3f} s) do not "
                          "overlap in time",
                          s(images.front().stamp), s(images.back().stamp), s(poses.front().stamp),
                          s(poses.back().stamp)),
              "use the groundtruth.txt of the same recording and clock");
}

/// What the folder is made of, checked and sorted by time.
struct TumRecording {
  std::vector<TumImage> images;
  std::vector<TumPose> poses;
  FolderCamera camera;
};

class TumSource final : public FrameSource {
 public:
  TumSource(SourceInfo info, const FolderOptions& options, TumRecording recording)
      : folder_(options.folder),
        axes_(options.up.value_or(kTumAxes)),
        images_(std::move(recording.images)),
        poses_(std::move(recording.poses)),
        camera_(std::move(recording.camera)),
        rig_({.cameras = {{.T_body_camera = forward_looking_camera()}},
              .poses = {.track = {}, .gates = PoseGates::open()}}),
        info_(std::move(info)) {}

  Expected<std::optional<Frame>> next() override {
    while (next_image_ < images_.size()) {
      if (auto frame = rig_.pop()) return frame;
      const TumImage& image = images_[next_image_++];
      auto depth = camera_.read(folder_ / image.file, image.stamp);
      if (depth) {
        push_poses_until(image.stamp);
        rig_.push(std::move(*depth));
      } else {
        rig_.lose(loss_of_image(depth.error()));
        skipped_.add(std::move(depth).error());
      }
    }
    rig_.finish();
    if (auto frame = rig_.pop()) return frame;
    return skipped_.end(rig_.tally());
  }

  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return rig_.tally(); }
  const RigStatistics* statistics() const override { return &rig_.statistics(); }
  const RigOptions* rig() const override { return &rig_.options(); }
  std::vector<RigEvent> take_events() override { return skipped_.take_events(); }

 private:
  [[nodiscard]] PoseSample in_our_world(const TumPose& pose) const {
    const auto T_native_camera =
        Transform<NativeWorld, Camera>::from(pose.R_native_camera, pose.t_native_camera_m);
    // What is no pose goes on as it is: the gates say what is wrong with it, and count it.
    if (!T_native_camera) return {pose.stamp, pose.R_native_camera, pose.t_native_camera_m};
    const Transform<World, Body> T_world_body =
        world_from(axes_) * *T_native_camera * forward_looking_camera().inverse();
    return {pose.stamp, T_world_body.rotation(), T_world_body.translation()};
  }

  /// As a live rig would see it: every pose up to the first that is not before the image.
  void push_poses_until(Stamp stamp) {
    while (next_pose_ < poses_.size()) {
      const TumPose& pose = poses_[next_pose_++];
      rig_.push(in_our_world(pose));
      if (pose.stamp >= stamp) return;
    }
    rig_.finish();
  }

  fs::path folder_;
  WorldAxes axes_;
  std::vector<TumImage> images_;  // ascending stamps
  std::vector<TumPose> poses_;    // ascending stamps
  FolderCamera camera_;
  Rig rig_;
  SourceInfo info_;
  SkippedRecords skipped_;
  std::size_t next_image_ = 0;
  std::size_t next_pose_ = 0;
};

Expected<TumRecording> read_recording(const FolderOptions& options, FolderCameraRequest request) {
  const fs::path& folder = options.folder;
  auto images = read_tum_images(folder / "depth.txt");
  if (!images) return forward_error(std::move(images));
  shift_times(*images, options.time_offset);
  auto poses = read_tum_poses(folder / "groundtruth.txt");
  if (!poses) return forward_error(std::move(poses));
  if (auto usable = check_overlap(folder, *images, *poses); !usable)
    return forward_error(std::move(usable));
  recognise(request);
  std::vector<fs::path> files;
  for (const TumImage& image : *images) files.push_back(folder / image.file);
  auto camera = FolderCamera::open(request, files);
  if (!camera) return forward_error(std::move(camera));
  return TumRecording{std::move(*images), std::move(*poses), std::move(*camera)};
}

}  // namespace

Expected<FrameSourcePtr> open_tum_source(std::string_view rest) {
  auto options = parse_folder_options(rest, "tum", true);
  if (!options) return forward_error(std::move(options));
  if (auto usable = check_folder(options->folder, kTumContent); !usable)
    return forward_error(std::move(usable));
  DepthPngFormat format = kTumFormat;
  format.unit_m = options->depth_unit_m.value_or(kTumFormat.unit_m);
  auto recording = read_recording(
      *options, {.folder = options->folder, .format = format, .intrinsics = options->intrinsics});
  if (!recording) return forward_error(std::move(recording));
  SourceInfo info{.uri = "tum:" + std::string(rest),
                  .native_up_axis = std::string(up_axis(options->up.value_or(kTumAxes))),
                  .frame_count = recording->images.size(),
                  .baseline_m = kTumBaseline_m,
                  .intrinsics = recording->camera.note()};
  if (!options->depth_unit_m) info.assumed_depth_unit_m = kTumFormat.unit_m;
  return std::make_unique<TumSource>(std::move(info), *options, std::move(*recording));
}

}  // namespace swiftlet
