// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/rig_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "swiftlet/file/file_content.hpp"
#include "swiftlet/file/yaml_document_private.hpp"
#include "swiftlet/sim/flight.hpp"
#include "swiftlet/sim/yaml_section_private.hpp"

namespace swiftlet {
namespace {

using sim::YamlProblem;
using sim::YamlSection;

constexpr std::string_view kIntelMount = "intel_t265_d435";
constexpr double kRadPerDeg = std::numbers::pi / 180.0;

Nanoseconds duration(double s) { return Nanoseconds(std::llround(s * 1e9)); }

/// The place of a word in a list of those that are allowed; the first and a problem for others.
std::size_t one_of(YamlSection& section, std::string_view key,
                   std::span<const std::string_view> allowed, std::string_view fallback) {
  const std::string word = section.text(key, std::string(fallback));
  const auto found = std::ranges::find(allowed, word);
  if (found != allowed.end()) return static_cast<std::size_t>(found - allowed.begin());
  section.problem(fmt::format("'{}' cannot be '{}'", key, word),
                  fmt::format("it may be {}", fmt::join(allowed, ", ")));
  return 0;
}

/// A mount, written in one of three ways: by the name of a preset, as a matrix, or as place and
/// angles.
Expected<Transform<Body, Camera>> read_mount(YamlSection& camera) {
  const bool is_preset = camera.has("mount");
  const bool is_matrix = camera.has("matrix");
  const bool is_angles = camera.has("at_m");
  if (int{is_preset} + int{is_matrix} + int{is_angles} != 1)
    return fail(ErrorCode::kInvalidConfig, {}, "a camera needs exactly one of mount, matrix, at_m",
                fmt::format("for Intel's bracket write mount: {}", kIntelMount));
  if (is_preset) {
    if (camera.text("mount") == kIntelMount) return intel_t265_d435_mount();
    return fail(ErrorCode::kInvalidConfig, {}, "there is no such mount",
                fmt::format("known is: {}", kIntelMount));
  }
  if (is_matrix) {
    const auto values = camera.numbers("matrix", 12);
    Eigen::Matrix<double, 3, 4> M;
    for (int i = 0; i < 12; ++i) M(i / 4, i % 4) = values[static_cast<std::size_t>(i)];
    return mount_from_matrix(
        M, static_cast<BodyAxes>(one_of(camera, "axes", kBodyAxesNames, "rep103")));
  }
  const auto angle = [&](std::string_view key) {
    return camera.number(key, {-360.0, 360.0}, 0.0) * kRadPerDeg;
  };
  const Eigen::Vector3d at_m = camera.vector("at_m");
  const double yaw = angle("yaw_deg");
  const double pitch = angle("pitch_deg");
  const Eigen::Quaterniond R = sim::rotation_from_ypr(yaw, pitch, angle("roll_deg"));
  return Transform<Body, Body>::trusted(R, at_m) * forward_looking_camera();
}

RigCamera read_camera(YamlSection& section, std::size_t number) {
  RigCamera camera;
  camera.name = section.text("name", fmt::format("camera{}", number));
  camera.stream = section.text("stream", "");
  camera.pose_offset = duration(section.number("pose_offset_s", {-1.0, 1.0}, 0.0));
  camera.baseline_m = section.number("baseline_m", {0.0, 1.0}, 0.0);
  std::string looks = section.text("looks", "");
  if (!looks.empty() && std::ranges::find(kDirections, looks) == kDirections.end()) {
    section.problem(fmt::format("a camera cannot look '{}'", looks),
                    fmt::format("it may look {}", fmt::join(kDirections, ", ")));
    looks.clear();
  }
  auto mount = read_mount(section);
  if (mount) camera.T_body_camera = *mount;
  const Status check =
      mount ? check_mount(*mount, looks) : Status(tl::make_unexpected(mount.error()));
  if (!check)
    section.problem(fmt::format("the mount of '{}': {}", camera.name, check.error().what),
                    check.error().remedy);
  section.finish();
  return camera;
}

void read_pose(YamlSection section, RigDescription& out) {
  constexpr std::array<std::string_view, 2> kPolicies{"keep", "clear"};
  PoseGates& gates = out.rig.poses.gates;
  out.pose_stream = section.text("stream", "");
  out.body_frame = section.text("body_frame", "");
  out.pose_axes = static_cast<BodyAxes>(one_of(section, "axes", kBodyAxesNames, "rep103"));
  const sim::Limits confidence{0.0, 3.0};
  gates.min_confidence = static_cast<std::uint8_t>(
      section.number("min_confidence", confidence, static_cast<double>(gates.min_confidence)));
  const auto positive = [&](std::string_view key, double fallback) {
    return section.number(key, sim::kPositive, fallback);
  };
  gates.max_speed_mps = positive("max_speed_mps", gates.max_speed_mps);
  gates.max_acceleration_mps2 = positive("max_acceleration_mps2", gates.max_acceleration_mps2);
  gates.max_turn_radps = positive("max_turn_degps", gates.max_turn_radps / kRadPerDeg) * kRadPerDeg;
  gates.slack_m = positive("slack_m", gates.slack_m);
  gates.slack_rad = positive("slack_deg", gates.slack_rad / kRadPerDeg) * kRadPerDeg;
  gates.on_jump = static_cast<JumpPolicy>(one_of(section, "on_jump", kPolicies, "keep"));
  auto& track = out.rig.poses.track;
  track.max_gap = duration(section.number("max_gap_s", {0.001, 10.0}, seconds(track.max_gap)));
  out.rig.stale_after =
      duration(section.number("stale_after_s", {0.01, 60.0}, seconds(out.rig.stale_after)));
  section.finish();
}

void read_body_box(YamlSection section, RigDescription& out) {
  const BodyBox box{section.vector("from_m"), section.vector("to_m")};
  if ((box.to_m - box.from_m).minCoeff() <= 0.0)
    section.problem("the body box has no inside", "each number of to_m lies above that of from_m");
  out.rig.body_box = box;
  section.finish();
}

RigDescription read_rig(const YAML::Node& root, YamlProblem& problem) {
  YamlSection section(root, "the rig", problem);
  RigDescription out = intel_t265_d435_rig();
  out.rig.cameras.clear();
  for (YamlSection& camera : section.list("cameras"))
    out.rig.cameras.push_back(read_camera(camera, out.rig.cameras.size()));
  if (out.rig.cameras.empty() || out.rig.cameras.size() > kMaxCameras)
    section.problem(fmt::format("a rig has 1 to {} cameras", kMaxCameras));
  if (auto pose = section.section("pose")) read_pose(*pose, out);
  if (auto box = section.section("body_box")) read_body_box(*box, out);
  section.finish();
  return out;
}

}  // namespace

PoseGates tracker_gates() {
  PoseGates gates;
  gates.min_confidence = 2;  // below medium a T265 may have lost its way
  return gates;
}

RigDescription intel_t265_d435_rig() {
  RigDescription out;
  out.rig.cameras = {RigCamera{.T_body_camera = intel_t265_d435_mount()}};
  out.rig.poses.gates = tracker_gates();
  return out;
}

Expected<RigDescription> parse_rig(std::string_view yaml, std::string_view origin) {
  YamlProblem problem{std::string(origin), std::nullopt};
  auto root = parse_yaml(yaml, problem.file);
  if (!root) return forward_error(std::move(root));
  // yaml-cpp reports by exception; none passes this function.
  try {
    RigDescription rig = read_rig(*root, problem);
    if (!problem.first) return rig;
  } catch (const YAML::Exception& error) {
    problem.add(error.mark, fmt::format("not YAML: {}", error.msg));
  }
  return tl::make_unexpected(*problem.first);
}

Expected<RigDescription> load_rig(const std::filesystem::path& path) {
  auto text = read_text_file(path, kMostSettingsBytes);
  if (!text) return forward_error(std::move(text));
  return parse_rig(*text, path.string());
}

}  // namespace swiftlet
