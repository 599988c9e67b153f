// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "swiftlet/file/file_content.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/rig/pose_line.hpp"
#include "swiftlet/source/text_file.hpp"

// Poses as text beside a recording of images: what `swiftlet record` writes of a pose source that
// is no RealSense, and TUM's trajectories.

namespace swiftlet {
namespace {

class TextPoses final : public PoseStream {
 public:
  explicit TextPoses(std::vector<PoseSample> poses) : poses_(std::move(poses)) {}

  Expected<std::optional<PoseSample>> next() override {
    if (next_ == poses_.size()) return std::nullopt;
    return poses_[next_++];
  }

 private:
  std::vector<PoseSample> poses_;
  std::size_t next_ = 0;
};

}  // namespace

Expected<BagPoses> open_text_poses(const std::filesystem::path& path, const BagTopics& topics) {
  auto text = read_text_file(path, kMostListBytes);
  if (!text) return forward_error(std::move(text));
  std::vector<PoseSample> poses;
  for (const TextRow& row : rows_of(*text)) {
    auto pose = parse_pose_words(row.words, topics.pose_axes);
    if (!pose) {
      pose.error().where = fmt::format("{}:{}", path.string(), row.line);
      return forward_error(std::move(pose));
    }
    poses.push_back(*pose);
  }
  if (poses.empty())
    return fail(ErrorCode::kCorruptInput, path.string(), "it holds no poses",
                fmt::format("a line is: {}", kPoseColumns));
  return BagPoses{std::make_unique<TextPoses>(std::move(poses)),
                  path.string(),
                  {},
                  false,
                  "poses from " + path.string()};
}

}  // namespace swiftlet
