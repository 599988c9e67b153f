// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/folders/folder_camera.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/folders/matrix_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr int kKnownWidth = 640;
constexpr int kKnownHeight = 480;
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

/// nullopt if the text is no list of four; then it names a file.
std::optional<Expected<PinholeIntrinsics>> from_numbers(const std::string& text, int width,
                                                        int height) {
  const std::vector<std::string> parts = split_list(text);
  std::array<double, 4> value{};
  if (parts.size() != value.size()) return std::nullopt;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto number = parse_number(parts[i]);
    if (!number) return std::nullopt;
    value[i] = *number;
  }
  auto intrinsics =
      PinholeIntrinsics::create(width, height, value[0], value[1], value[2], value[3]);
  if (!intrinsics) intrinsics.error().where = "intrinsics=" + text;
  return intrinsics;
}

struct NotedIntrinsics {
  PinholeIntrinsics intrinsics;
  IntrinsicsNote note;
};

Expected<NotedIntrinsics> noted(Expected<PinholeIntrinsics>&& intrinsics, IntrinsicsOrigin origin,
                                std::string detail) {
  if (!intrinsics) return forward_error(std::move(intrinsics));
  return NotedIntrinsics{*intrinsics, {origin, std::move(detail)}};
}

tl::unexpected<Error> nobody_tells(const FolderCameraRequest& request, int width, int height) {
  const std::string dataset = request.known
                                  ? fmt::format("; those of {} are known for {} x {} only",
                                                request.known->name, kKnownWidth, kKnownHeight)
                                  : "";
  return fail(ErrorCode::kNotFound, request.folder.string(),
              fmt::format("nobody tells the intrinsics of its camera ({} x {} pixels{})", width,
                          height, dataset),
              fmt::format("add a {} (fx 0 cx / 0 fy cy / 0 0 1, in pixels), or write them behind "
                          "the folder: ?intrinsics=fx,fy,cx,cy",
                          kIntrinsicsFile));
}

Expected<NotedIntrinsics> intrinsics_of(const FolderCameraRequest& request, int width, int height) {
  if (!request.intrinsics.empty()) {
    if (auto given = from_numbers(request.intrinsics, width, height))
      return noted(std::move(*given), IntrinsicsOrigin::kOption, request.intrinsics);
    return noted(from_file(request.intrinsics, width, height), IntrinsicsOrigin::kFile,
                 request.intrinsics);
  }
  const fs::path file = request.folder / kIntrinsicsFile;
  std::error_code absent;
  if (fs::exists(file, absent))
    return noted(from_file(file, width, height), IntrinsicsOrigin::kFile, file.string());
  if (!request.known || width != kKnownWidth || height != kKnownHeight)
    return nobody_tells(request, width, height);
  const KnownCamera& known = *request.known;
  return noted(
      PinholeIntrinsics::create(width, height, known.fx_px, known.fy_px, known.cx_px, known.cy_px),
      IntrinsicsOrigin::kKnownDataset, fmt::format("{}, by {}", known.name, request.recognised_by));
}

/// The first image that can be read; the error of the very first if there is none.
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

Expected<FolderCamera> FolderCamera::open(const FolderCameraRequest& request,
                                          const std::vector<fs::path>& images) {
  auto first = first_readable(images, request.format);
  if (!first) return forward_error(std::move(first));
  auto found = intrinsics_of(request, first->raw.width(), first->raw.height());
  if (!found) return forward_error(std::move(found));
  return FolderCamera(request.format, found->intrinsics, std::move(found->note));
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
