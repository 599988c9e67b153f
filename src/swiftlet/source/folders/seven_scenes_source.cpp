// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/source/folders/folder_camera.hpp"
#include "swiftlet/source/folders/folder_options.hpp"
#include "swiftlet/source/folders/matrix_file.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig/world_axes.hpp"
#include "swiftlet/source/skipped_records.hpp"

// Microsoft 7-Scenes, and everything else that is written in its layout: one folder with
//   frame-000123.depth.png   16-bit millimetres, 0 and 65535 = no reading
//   frame-000123.pose.txt    4 x 4 camera-to-world, optical axes, metres
//   camera-intrinsics.txt    not needed for a sequence of the data set itself
// Source: Shotton et al. 2013 and the data set's readme. World: the first camera's optical axes.

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kContent =
    "frame-XXXXXX.depth.png and frame-XXXXXX.pose.txt, as 7-Scenes does";
constexpr std::string_view kPrefix = "frame-";
constexpr std::string_view kDepthSuffix = ".depth.png";
constexpr std::string_view kColourSuffix = ".color.png";
constexpr std::string_view kPoseSuffix = ".pose.txt";
constexpr DepthPngFormat kFormat{.unit_m = 0.001F, .is_full_scale_invalid = true};
constexpr KnownCamera kKinect{"7-Scenes", 585.0, 585.0, 320.0, 240.0};
constexpr double kKinectBaseline_m = 0.075;
constexpr std::int64_t kFrameRate_hz = 30;
constexpr WorldAxes kAxes = WorldAxes::kOptical;

struct RecordedFrame {
  std::uint32_t number;
  fs::path depth;
  fs::path pose;

  /// The layout has no clock: frames are numbered at 30 Hz, and numbers may skip.
  [[nodiscard]] Stamp stamp() const { return Stamp{number * 1'000'000'000LL / kFrameRate_hz}; }
};

std::optional<RecordedFrame> frame_of(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(kPrefix) || !name.ends_with(kDepthSuffix)) return std::nullopt;
  const char* const end = name.data() + name.size() - kDepthSuffix.size();
  std::uint32_t number = 0;
  const auto parsed = std::from_chars(name.data() + kPrefix.size(), end, number);
  if (parsed.ec != std::errc{} || parsed.ptr != end) return std::nullopt;
  const std::string stem(name.data(), end);
  return RecordedFrame{number, file, file.parent_path() / (stem + std::string(kPoseSuffix))};
}

Expected<std::vector<RecordedFrame>> list_frames(const fs::path& folder) {
  std::vector<RecordedFrame> frames;
  std::error_code refused;
  bool has_sequences = false;
  for (fs::directory_iterator entry(folder, refused), end; !refused && entry != end;
       entry.increment(refused)) {
    if (auto frame = frame_of(entry->path())) frames.push_back(std::move(*frame));
    has_sequences |= entry->path().filename().string().starts_with("seq-");
  }
  if (refused) return fail(ErrorCode::kIo, folder.string(), "cannot be read: " + refused.message());
  if (frames.empty()) {
    return fail(ErrorCode::kNotFound, folder.string(), "it holds no depth images",
                has_sequences ? "name one of its sequences, as in " + (folder / "seq-01").string()
                              : fmt::format("it should hold {}", kContent));
  }
  std::ranges::sort(frames, {}, &RecordedFrame::number);
  return frames;
}

/// What can be known before the first frame is delivered.
Status check_frames(const std::vector<RecordedFrame>& frames) {
  const auto twin = std::ranges::adjacent_find(frames, {}, &RecordedFrame::number);
  if (twin == frames.end()) return Done{};
  return fail(ErrorCode::kCorruptInput, twin->depth.string(),
              "another file has the same frame number: " + std::next(twin)->depth.string(),
              "remove one of them");
}

/// Recognises a sequence of the data set: a folder "seq-01" that has colour beside the depth, as
/// frame-000000.color.png. Others write in the same layout, but not in such folders.
void recognise_sequence(const std::vector<RecordedFrame>& frames, FolderCameraRequest& request) {
  std::error_code refused;
  const fs::path real = fs::canonical(request.folder, refused);
  const std::string name = (refused ? request.folder : real).filename().string();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool is_sequence =
      name.size() == 6 && name.starts_with("seq-") && is_digit(name[4]) && is_digit(name[5]);
  std::string colour = frames.front().depth.string();
  colour.replace(colour.size() - kDepthSuffix.size(), kDepthSuffix.size(), kColourSuffix);
  if (!is_sequence || !fs::exists(colour, refused)) return;
  request.known = kKinect;
  request.recognised_by = "a folder seq-NN with colour images";
}

Expected<Transform<World, Camera>> read_pose(const fs::path& path, WorldAxes axes) {
  auto matrix = read_matrix4(path);
  if (!matrix) return forward_error(std::move(matrix));
  auto T_native_camera = Transform<NativeWorld, Camera>::from_matrix(*matrix);
  if (!T_native_camera) {
    return fail(T_native_camera.error().code, path.string(), T_native_camera.error().what,
                "a pose is camera-to-world, R t / 0 0 0 1 in metres; correct it, or remove it "
                "together with its depth image");
  }
  return world_from(axes) * *T_native_camera;
}

class SevenScenesSource final : public FrameSource {
 public:
  SevenScenesSource(SourceInfo info, std::vector<RecordedFrame> frames, FolderCamera camera,
                    WorldAxes axes)
      : frames_(std::move(frames)),
        camera_(std::move(camera)),
        axes_(axes),
        info_(std::move(info)) {}

  Expected<std::optional<Frame>> next() override {
    while (next_ < frames_.size()) {
      if (auto frame = read(frames_[next_++])) {
        ++tally_.delivered;
        return frame;
      }
    }
    return skipped_.end(tally_);
  }

  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return tally_; }
  std::vector<RigEvent> take_events() override { return skipped_.take_events(); }

 private:
  std::nullopt_t skip(FrameLoss loss, Error why) {
    ++tally_.of(loss);
    skipped_.add(std::move(why));
    return std::nullopt;
  }

  /// nullopt, and counted, if its pose or its image is bad.
  [[nodiscard]] std::optional<Frame> read(const RecordedFrame& recorded) {
    auto T_world_camera = read_pose(recorded.pose, axes_);
    if (!T_world_camera) {
      const bool is_missing = T_world_camera.error().code == ErrorCode::kNotFound;
      return skip(is_missing ? FrameLoss::kNoPose : FrameLoss::kPoseRefused,
                  std::move(T_world_camera).error());
    }
    auto seen = camera_.read(recorded.depth, recorded.stamp());
    if (!seen) {
      const FrameLoss loss = loss_of_image(seen.error());
      return skip(loss, std::move(seen).error());
    }
    return Frame{seen->stamp, std::move(seen->depth), seen->intrinsics, *T_world_camera};
  }

  std::vector<RecordedFrame> frames_;  // ascending numbers, all different
  FolderCamera camera_;
  WorldAxes axes_;
  SourceInfo info_;
  FrameTally tally_;
  SkippedRecords skipped_;
  std::size_t next_ = 0;
};

Expected<FolderCamera> open_camera(const FolderOptions& options,
                                   const std::vector<RecordedFrame>& frames) {
  DepthPngFormat format = kFormat;
  format.unit_m = options.depth_unit_m.value_or(kFormat.unit_m);
  FolderCameraRequest request{
      .folder = options.folder, .format = format, .intrinsics = options.intrinsics};
  recognise_sequence(frames, request);
  std::vector<fs::path> images;
  for (const RecordedFrame& frame : frames) images.push_back(frame.depth);
  return FolderCamera::open(request, images);
}

}  // namespace

Expected<FrameSourcePtr> open_seven_scenes_source(std::string_view rest) {
  auto options = parse_folder_options(rest, "7scenes", false);
  if (!options) return forward_error(std::move(options));
  if (auto usable = check_folder(options->folder, kContent); !usable)
    return forward_error(std::move(usable));
  auto frames = list_frames(options->folder);
  if (!frames) return forward_error(std::move(frames));
  if (auto usable = check_frames(*frames); !usable) return forward_error(std::move(usable));
  auto camera = open_camera(*options, *frames);
  if (!camera) return forward_error(std::move(camera));
  const WorldAxes axes = options->up.value_or(kAxes);
  SourceInfo info{.uri = "7scenes:" + std::string(rest),
                  .native_up_axis = std::string(up_axis(axes)),
                  .frame_count = frames->size(),
                  .baseline_m = kKinectBaseline_m,
                  .intrinsics = camera->note()};
  if (!options->depth_unit_m) info.assumed_depth_unit_m = kFormat.unit_m;
  return std::make_unique<SevenScenesSource>(std::move(info), std::move(*frames),
                                             std::move(*camera), axes);
}

}  // namespace swiftlet
