// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/folders/openloris_calibration.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/file/file_content.hpp"
#include "swiftlet/file/yaml_document_private.hpp"
#include "swiftlet/source/rig/frame_tree.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> wrong(const fs::path& file, std::string what) {
  return fail(ErrorCode::kCorruptInput, file.string(), std::move(what),
              "it should be the file of the data set");
}

/// OpenCV writes "%YAML:1.0", which is not YAML's own form of that line.
std::string without_directive(std::string text) {
  if (!text.starts_with('%')) return text;
  return text.substr(std::min(text.find('\n'), text.size()));
}

/// Calls read(root) with a file's content; yaml-cpp reports by exception, and none passes here.
template <class Read>
auto with_yaml(const fs::path& file, Read read) -> decltype(read(YAML::Node())) {
  auto text = read_text_file(file, kMostSettingsBytes);
  if (!text) {
    text.error().remedy =
        "an OpenLORIS-Scene folder holds depth.txt, groundtruth.txt, "
        "sensors.yaml, trans_matrix.yaml and the images";
    return forward_error(std::move(text));
  }
  auto root = parse_yaml(without_directive(std::move(*text)), file.string());
  if (!root) {
    root.error().code = ErrorCode::kCorruptInput;  // a recording's, not the user's
    return forward_error(std::move(root));
  }
  try {
    return read(*root);
  } catch (const YAML::Exception& error) {
    return fail(ErrorCode::kCorruptInput, fmt::format("{}:{}", file.string(), error.mark.line + 1),
                "not the YAML of a calibration: " + error.msg);
  }
}

/// A number, whatever the locale of the host program, which yaml-cpp's own conversion follows.
template <class Number>
Number yaml_number(const YAML::Node& node) {
  const auto number = number_from<Number>(node.Scalar());
  if (!number) throw YAML::RepresentationException(node.Mark(), "this should be a number");
  return *number;
}

/// The numbers of an !!opencv-matrix.
std::vector<double> matrix(const YAML::Node& node) {
  std::vector<double> values;
  for (const YAML::Node& value : node["data"]) values.push_back(yaml_number<double>(value));
  return values;
}

Expected<PinholeIntrinsics> intrinsics_from(const fs::path& file, const YAML::Node& camera) {
  if (!camera) return wrong(file, "it does not know the camera");
  if (const YAML::Node D = camera["distortion_coefficients"]) {
    if (std::ranges::any_of(matrix(D), [](double d) { return d != 0.0; }))
      return fail(ErrorCode::kUnsupported, file.string(), "its images have lens distortion");
  }
  const std::vector<double> values = matrix(camera["intrinsics"]);
  if (values.size() != 4) return wrong(file, "a camera has four intrinsics: fx, cx, fy, cy");
  const auto [fx, cx, fy, cy] = std::tie(values[0], values[1], values[2], values[3]);
  if (!(std::abs(fx / fy - 1.0) < 0.2))
    return wrong(file, "the intrinsics are not in the data set's own order, fx, cx, fy, cy");
  auto intrinsics = PinholeIntrinsics::create(yaml_number<int>(camera["width"]),
                                              yaml_number<int>(camera["height"]), fx, fy, cx, cy);
  if (!intrinsics) intrinsics.error().where = file.string();
  return intrinsics;
}

Expected<FrameTree> tree_from(const fs::path& file, const YAML::Node& root) {
  FrameTree tree;
  for (const YAML::Node& tie : root["trans_matrix"]) {
    const std::vector<double> values = matrix(tie["matrix"]);
    if (values.size() != 16) return wrong(file, "a transform is a 4 x 4 matrix");
    Eigen::Matrix4d M;
    for (int i = 0; i < 16; ++i) M(i / 4, i % 4) = values[static_cast<std::size_t>(i)];
    const auto T = Transform<Body, Camera>::from_matrix(M);
    if (!T) return wrong(file, T.error().what);
    auto added = tree.add(tie["parent_frame"].as<std::string>(),
                          tie["child_frame"].as<std::string>(), T->rotation(), T->translation());
    if (!added) return forward_error(std::move(added));
  }
  return tree;
}

}  // namespace

Expected<OpenLorisCamera> read_openloris_camera(const fs::path& folder, const std::string& frame) {
  const fs::path sensors = folder / "sensors.yaml";
  auto intrinsics = with_yaml(
      sensors, [&](const YAML::Node& root) { return intrinsics_from(sensors, root[frame]); });
  if (!intrinsics) return forward_error(std::move(intrinsics));
  const fs::path transforms = folder / "trans_matrix.yaml";
  auto tree =
      with_yaml(transforms, [&](const YAML::Node& root) { return tree_from(transforms, root); });
  if (!tree) return forward_error(std::move(tree));
  const auto mount = tree->mount("base_link", frame);
  if (!mount) return wrong(transforms, fmt::format("no chain leads from base_link to {}", frame));
  return OpenLorisCamera{*intrinsics, *mount};
}

}  // namespace swiftlet
