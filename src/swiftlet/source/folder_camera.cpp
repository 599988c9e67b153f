// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/folder_camera.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "swiftlet/source/matrix_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr int kPresetWidth = 640;
constexpr int kPresetHeight = 480;
constexpr std::string_view kIntrinsicsFile = "camera-intrinsics.txt";

Expected<PinholeIntrinsics> from_file(const fs::path& path, int width, int height) {
  auto K = read_matrix3(path);
  if (!K) return forward_error(std::move(K));
  auto intrinsics =
      PinholeIntrinsics::create(width, height, (*K)(0, 0), (*K)(1, 1), (*K)(0, 2), (*K)(1, 2));
  if (!intrinsics) {
    intrinsics.error().where = path.string();
    return intrinsics;
  }
  const bool is_pinhole =
      (*K)(0, 1) == 0.0 && (*K)(1, 0) == 0.0 && K->row(2) == Eigen::RowVector3d(0, 0, 1);
  if (!is_pinhole) {
    return fail(ErrorCode::kUnsupported, path.string(), "it is not a pinhole camera without skew",
                "write fx 0 cx / 0 fy cy / 0 0 1 in pixels");
  }
  return intrinsics;
}

Expected<PinholeIntrinsics> from_preset(const PinholePreset& preset, const fs::path& folder,
                                        int width, int height) {
  if (width != kPresetWidth || height != kPresetHeight) {
    return fail(ErrorCode::kUnsupported, folder.string(),
                fmt::format("its images have {} x {} pixels, but the intrinsics of "
                            "such recordings "
                            "are known for {} x {} only",
                            width, height, kPresetWidth, kPresetHeight),
                fmt::format("add a {}: fx 0 cx / 0 fy cy / 0 0 1", kIntrinsicsFile));
  }
  return PinholeIntrinsics::create(width, height, preset.fx_px, preset.fy_px, preset.cx_px,
                                   preset.cy_px);
}

/// The first image that can be read; the error of the very first if there is
/// none.
Expected<DepthImage> first_readable(const std::vector<fs::path>& images,
                                    const DepthPngFormat& format) {
  std::optional<Error> first_fault;
  for (const fs::path& image : images) {
    auto depth = read_depth_png(image, format);
    if (depth) return depth;
    if (!first_fault) first_fault = std::move(depth).error();
  }
  if (first_fault) return tl::make_unexpected(*std::move(first_fault));
  return fail(ErrorCode::kNotFound, {}, "there are no images");
}

}  // namespace

Status check_folder(const fs::path& folder, std::string_view content) {
  const std::string remedy = fmt::format("it should hold {}", content);
  if (folder.empty()) return fail(ErrorCode::kUsage, {}, "no folder is named", remedy);

  std::error_code refused;
  const fs::file_status status = fs::status(folder, refused);
  if (status.type() == fs::file_type::not_found)
    return fail(ErrorCode::kNotFound, folder.string(), "there is no such folder", remedy);
  if (!refused && !fs::is_directory(status))
    return fail(ErrorCode::kNotFound, folder.string(), "it is a file, not a folder", remedy);

  const bool is_empty = !refused && fs::is_empty(folder, refused);
  if (refused) return fail(ErrorCode::kIo, folder.string(), "cannot be read: " + refused.message());
  if (is_empty) return fail(ErrorCode::kNotFound, folder.string(), "the folder is empty", remedy);
  return Done{};
}

Expected<FolderCamera> FolderCamera::open(const fs::path& folder,
                                          const std::vector<fs::path>& images,
                                          const DepthPngFormat& format,
                                          const PinholePreset& preset) {
  auto first = first_readable(images, format);
  if (!first) return forward_error(std::move(first));

  const int width = first->raw.width();
  const int height = first->raw.height();
  const fs::path file = folder / kIntrinsicsFile;
  std::error_code absent;
  auto intrinsics = fs::exists(file, absent) ? from_file(file, width, height)
                                             : from_preset(preset, folder, width, height);
  if (!intrinsics) return forward_error(std::move(intrinsics));
  return FolderCamera(format, *intrinsics);
}

Expected<DepthFrame> FolderCamera::read(const fs::path& image, Stamp stamp) const {
  auto depth = read_depth_png(image, format_);
  if (!depth) return forward_error(std::move(depth));
  if (depth->raw.width() != intrinsics_.width() || depth->raw.height() != intrinsics_.height()) {
    return fail(
        ErrorCode::kCorruptInput, image.string(),
        fmt::format("it has {} x {} pixels, but the first image has {} x {}", depth->raw.width(),
                    depth->raw.height(), intrinsics_.width(), intrinsics_.height()),
        "a folder holds the images of one camera");
  }
  return DepthFrame{stamp, std::move(*depth), intrinsics_};
}

}  // namespace swiftlet
