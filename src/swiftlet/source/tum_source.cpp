// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/source/folder_camera.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig.hpp"
#include "swiftlet/source/skipped_records.hpp"
#include "swiftlet/source/tum_lists.hpp"
#include "swiftlet/source/world_axes.hpp"

// TUM RGB-D: depth.txt lists 16-bit images (5000 steps a metre, 0 = no
// reading), groundtruth.txt the path of the camera; each with its own clock
// ticks. The pose of an image is interpolated at the image's own time, not
// taken from the nearest neighbour. Images and poses that are bad are left out
// and counted. Source: Sturm et al. 2012 and the data set's pages "File
// Formats", "Intrinsic Camera Calibration".

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kContent = "depth.txt, groundtruth.txt and the images they list";
// Full scale, 13.1 m, is beyond any Kinect: a clipped value, not a reading.
constexpr DepthPngFormat kFormat{.unit_m = 1.0F / 5000.0F, .is_full_scale_invalid = true};
constexpr double kKinectBaseline_m = 0.075;
constexpr WorldAxes kAxes = WorldAxes::kZUp;  // motion capture

struct NamedPreset {
  std::string_view mark;  // found in the name of the folder
  PinholePreset preset;
};
constexpr std::array kPresets{
    NamedPreset{"freiburg1", {517.3, 516.5, 318.6, 255.3}},
    NamedPreset{"freiburg2", {520.9, 521.0, 325.1, 249.7}},
    NamedPreset{"freiburg3", {535.4, 539.2, 320.1, 247.6}},
    NamedPreset{"fr1", {517.3, 516.5, 318.6, 255.3}},
    NamedPreset{"fr2", {520.9, 521.0, 325.1, 249.7}},
    NamedPreset{"fr3", {535.4, 539.2, 320.1, 247.6}},
};
constexpr PinholePreset kRosDefault{525.0, 525.0, 319.5, 239.5};

PinholePreset preset_for(const fs::path& folder) {
  std::error_code refused;
  const fs::path real = fs::canonical(folder, refused);  // so that "." and "dir/" have a name too
  const std::string name = (refused ? folder : real).filename().string();
  for (const NamedPreset& named : kPresets) {
    if (name.find(named.mark) != std::string::npos) return named.preset;
  }
  return kRosDefault;
}

Status check_overlap(const fs::path& folder, const std::vector<TumImage>& images,
                     const std::vector<TumPose>& poses) {
  const Stamp from = std::max(images.front().stamp, poses.front().stamp);
  const Stamp until = std::min(images.back().stamp, poses.back().stamp);
  if (from <= until) return Done{};
  const auto s = [](Stamp stamp) { return seconds(Nanoseconds(stamp.ns)); };
  return fail(ErrorCode::kCorruptInput, folder.string(),
              fmt::format("depth ({:.3f} to {:.3f} s) and ground truth ({:.3f} "
                          "to {:.3f} s) do not "
                          "overlap in time",
                          s(images.front().stamp), s(images.back().stamp), s(poses.front().stamp),
                          s(poses.back().stamp)),
              "use the groundtruth.txt of the same recording and clock");
}

class TumSource final : public FrameSource {
 public:
  TumSource(std::string_view folder, std::vector<TumImage> images, std::vector<TumPose> poses,
            const FolderCamera& camera)
      : folder_(folder),
        images_(std::move(images)),
        poses_(std::move(poses)),
        camera_(camera),
        rig_({.cameras = {{.T_body_camera = forward_looking_camera()}},
              .poses = {.track = {}, .gates = PoseGates::open()}}) {
    info_ = {.uri = "tum:" + std::string(folder),
             .native_up_axis = std::string(up_axis(kAxes)),
             .frame_count = images_.size(),
             .baseline_m = kKinectBaseline_m};
  }

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
  const RigFacts* facts() const override { return &rig_.facts(); }
  const RigOptions* rig() const override { return &rig_.options(); }
  std::vector<RigEvent> take_events() override { return skipped_.take_events(); }

 private:
  [[nodiscard]] PoseSample in_our_world(const TumPose& pose) const {
    const auto T_native_camera =
        Transform<NativeWorld, Camera>::from(pose.R_native_camera, pose.t_native_camera_m);
    // What is no pose goes on as it is: the gates say what is wrong with it,
    // and count it.
    if (!T_native_camera) return {pose.stamp, pose.R_native_camera, pose.t_native_camera_m};
    const Transform<World, Body> T_world_body =
        world_from(kAxes) * *T_native_camera * forward_looking_camera().inverse();
    return {pose.stamp, T_world_body.rotation(), T_world_body.translation()};
  }

  /// As a live rig would see it: every pose up to the first that is not before
  /// the image.
  void push_poses_until(Stamp stamp) {
    while (next_pose_ < poses_.size()) {
      const TumPose& pose = poses_[next_pose_++];
      rig_.push(in_our_world(pose));
      if (pose.stamp >= stamp) return;
    }
    rig_.finish();
  }

  fs::path folder_;
  std::vector<TumImage> images_;  // ascending stamps
  std::vector<TumPose> poses_;    // ascending stamps
  FolderCamera camera_;
  Rig rig_;
  SourceInfo info_;
  SkippedRecords skipped_;
  std::size_t next_image_ = 0;
  std::size_t next_pose_ = 0;
};

}  // namespace

Expected<FrameSourcePtr> open_tum_source(std::string_view folder_name) {
  const fs::path folder(folder_name);
  if (auto usable = check_folder(folder, kContent); !usable)
    return forward_error(std::move(usable));
  auto images = read_tum_images(folder / "depth.txt");
  if (!images) return forward_error(std::move(images));
  auto poses = read_tum_poses(folder / "groundtruth.txt");
  if (!poses) return forward_error(std::move(poses));
  if (auto usable = check_overlap(folder, *images, *poses); !usable)
    return forward_error(std::move(usable));
  std::vector<fs::path> files;
  for (const TumImage& image : *images) files.push_back(folder / image.file);
  auto camera = FolderCamera::open(folder, files, kFormat, preset_for(folder));
  if (!camera) return forward_error(std::move(camera));
  return std::make_unique<TumSource>(folder_name, std::move(*images), std::move(*poses), *camera);
}

}  // namespace swiftlet
