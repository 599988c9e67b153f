// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/file_or_recording.hpp"

#include <system_error>
#include <utility>

#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/bag/rosbag2/recording_folder.hpp"

namespace swiftlet {
namespace {

constexpr const char* kHowToMap =
    "map it with 'swiftlet map bag:PATH', look at it with 'swiftlet info'";

Expected<FileFacts> look_at_folder(const std::filesystem::path& folder) {
  auto files = files_of_recording(folder);
  if (files) return FileFacts{FileKind::kBag, "the folder of a recording", kHowToMap};
  std::error_code none;
  const bool is_any_folder = files.error().code == ErrorCode::kNotFound &&
                             !std::filesystem::exists(folder / "metadata.yaml", none);
  if (is_any_folder) return look_at_file(folder);
  return forward_error(std::move(files));
}

}  // namespace

Expected<FileFacts> look_at_file_or_recording(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return look_at_folder(path);
  auto facts = look_at_file(path);
  // A database without an owner that has a log may be a map whose writer was killed early.
  const bool may_be_recording =
      facts && (facts->kind == FileKind::kOther || facts->kind == FileKind::kMap);
  if (may_be_recording && is_recording(path))
    return FileFacts{FileKind::kBag, "a recording of ROS 2", kHowToMap};
  return facts;
}

}  // namespace swiftlet
