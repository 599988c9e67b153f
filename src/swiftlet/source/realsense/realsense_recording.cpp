// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <utility>

#include "swiftlet/source/realsense/realsense_rig_private.hpp"
#include "swiftlet/source/rig/pose_line.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

/// The SDK writes the devices' files itself; this counts, and writes the poses from elsewhere.
class RecordingSink final : public LiveSink {
 public:
  explicit RecordingSink(std::size_t cameras) : images_(cameras) {}
  Status open_poses(const fs::path& file) {
    poses_file_.open(file);
    poses_file_ << "# " << kPoseColumns << '\n' << std::flush;
    if (poses_file_) return Done{};
    return fail(ErrorCode::kIo, file.string(), "cannot be written");
  }

  void push(const PoseSample& pose) override {
    const std::lock_guard lock(mutex_);
    poses_.add();
    if (poses_file_.is_open()) poses_file_ << pose_line(pose) << '\n';
  }
  void push(DepthFrame depth) override {
    const std::lock_guard lock(mutex_);
    images_[depth.camera].add();
  }
  void note(RigEvent event) override {
    const std::lock_guard lock(mutex_);
    events_.add(std::move(event));
  }
  void start_poses_anew() override {}
  std::optional<HostTime> last_image(std::size_t camera) const override {
    const std::lock_guard lock(mutex_);
    return images_[camera].last;
  }
  std::optional<HostTime> last_pose() const override {
    const std::lock_guard lock(mutex_);
    return poses_.last;
  }

  [[nodiscard]] std::size_t images(std::size_t camera) const {
    const std::lock_guard lock(mutex_);
    return images_[camera].samples;
  }
  [[nodiscard]] std::size_t poses() const {
    const std::lock_guard lock(mutex_);
    return poses_.samples;
  }
  std::vector<RigEvent> take_events() {
    const std::lock_guard lock(mutex_);
    return events_.take();
  }

 private:
  struct Counter {
    std::size_t samples = 0;
    std::optional<HostTime> last{};
    void add() {
      ++samples;
      last = HostTime::clock::now();
    }
  };

  mutable std::mutex mutex_;
  std::vector<Counter> images_;
  Counter poses_;
  RigEventList events_;
  std::ofstream poses_file_;
};

class RealsenseRecording final : public LiveRecording {
 public:
  RealsenseRecording(fs::path folder, const RealsenseRequest& request)
      : folder_(std::move(folder)),
        cameras_(request.rig.rig.cameras),
        sink_(cameras_.size()),
        has_socket_(request.poses.has_value()) {}

  Status start(const RealsenseDevicesPtr& devices, const RealsenseRequest& request) {
    if (has_socket_) {
      if (auto opened = sink_.open_poses(folder_ / kPosesFile); !opened) return opened;
    }
    auto rig = RealsenseRig::start(devices, request, sink_,
                                   [this](const RealsenseDevice& device, std::string_view kind) {
                                     return recorder(device, kind);
                                   });
    if (!rig) return forward_error(std::move(rig));
    rig_ = std::move(*rig);
    return Done{};
  }

  std::vector<Stream> streams() const override {
    std::vector<Stream> all;
    for (std::size_t i = 0; i < cameras_.size(); ++i)
      all.push_back({cameras_[i].title(), file_of("depth", cameras_[i].stream), sink_.images(i)});
    all.push_back({has_socket_ ? "poses over UDP" : "T265",
                   has_socket_ ? folder_ / kPosesFile : file_of("t265", {}), sink_.poses()});
    return all;
  }
  std::vector<RigEvent> take_events() override { return sink_.take_events(); }

  static constexpr const char* kPosesFile = "poses.txt";

 private:
  struct File {
    std::string kind, serial;
    fs::path path;
  };

  rs2::device recorder(const RealsenseDevice& device, std::string_view kind) {
    const std::lock_guard lock(mutex_);
    const std::string stem = fmt::format("{}_{}", kind, device.facts.serial);
    const std::size_t part = ++parts_[stem];
    const std::string name =
        part == 1 ? fmt::format("{}.bag", stem) : fmt::format("{}_{}.bag", stem, part);
    const fs::path path = folder_ / name;
    files_.push_back({std::string(kind), device.facts.serial, path});
    return rs2::recorder(path.string(), device.device);
  }

  [[nodiscard]] fs::path file_of(std::string_view kind, std::string_view serial) const {
    const std::lock_guard lock(mutex_);
    const auto is_it = [&](const File& file) {
      return file.kind == kind && (serial.empty() || file.serial == serial);
    };
    const auto newest = std::find_if(files_.rbegin(), files_.rend(), is_it);
    return newest != files_.rend() ? newest->path : fs::path();
  }

  const fs::path folder_;
  const std::vector<RigCamera> cameras_;
  RecordingSink sink_;
  const bool has_socket_;
  mutable std::mutex mutex_;  // of the next two
  std::map<std::string, std::size_t> parts_;
  std::vector<File> files_;
  std::unique_ptr<RealsenseRig> rig_;  // last: it delivers into the sink
};

/// Creates the folder. Recordings are not to be replaced: whatever lies there already is an error.
Status claim(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return fail(ErrorCode::kIo, folder.string(), failed.message());
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const fs::path name = entry.path().filename();
    if (name.extension() == ".bag" || name == RealsenseRecording::kPosesFile)
      return fail(ErrorCode::kUsage, entry.path().string(), "the file exists",
                  "record into another folder");
  }
  if (failed) return fail(ErrorCode::kIo, folder.string(), failed.message());
  return Done{};
}

}  // namespace

Expected<LiveRecordingPtr> record_realsense(const RealsenseDevicesPtr& devices,
                                            const RealsenseRequest& request,
                                            const fs::path& folder) {
  if (auto found = survey_realsense(*devices, request); !found)
    return forward_error(std::move(found));
  if (auto claimed = claim(folder); !claimed) return forward_error(std::move(claimed));
  RealsenseRequest raw = request;
  raw.rig.pose_axes = BodyAxes::kRep103;  // poses are written as they came
  auto recording = std::make_unique<RealsenseRecording>(folder, raw);
  if (auto started = recording->start(devices, raw); !started)
    return forward_error(std::move(started));
  return recording;
}

Expected<LiveRecordingPtr> record_realsense(std::string_view rest, const fs::path& folder) {
  auto request = parse_realsense(rest);
  if (!request) return forward_error(std::move(request));
  auto devices = connected_realsense();
  if (!devices) return forward_error(std::move(devices));
  return record_realsense(*devices, *request, folder);
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
