// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim_source.hpp"

#if SWIFTLET_HAS_EMBREE

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/sim/stereo_camera.hpp"
#include "swiftlet/sim/tracker.hpp"
#include "swiftlet/source/rig.hpp"
#include "swiftlet/source/t265_axes.hpp"

namespace swiftlet {
namespace {

constexpr std::uint8_t kMediumConfidence = 2;  // Intel: below it, a T265 may have lost its way

struct SimOptions {
  std::optional<std::uint64_t> seed;
  bool has_noise = true;
  Nanoseconds start{0};
  std::optional<std::size_t> frames;
};

template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Applies one "key=value"; false if it cannot be meant.
bool apply(std::string_view key, std::string_view value, SimOptions& options) {
  if (key == "seed") return (options.seed = whole_number<std::uint64_t>(value)).has_value();
  if (key == "frames") return (options.frames = whole_number<std::size_t>(value)).has_value();
  if (key == "noise") {
    options.has_noise = value == "on";
    return value == "on" || value == "off";
  }
  const auto start = parse_stamp(value);
  if (key != "start" || !start || start->ns < 0) return false;
  options.start = Nanoseconds(start->ns);
  return true;
}

Expected<SimOptions> parse_options(std::string_view query) {
  SimOptions options;
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string_view value = pair.substr(std::min(equals + 1, pair.size()));
    if (!apply(pair.substr(0, equals), value, options)) {
      return fail(ErrorCode::kUsage, "sim", fmt::format("the option '{}' cannot be meant", pair),
                  "known are: seed=N, noise=on|off, start=SECONDS, frames=N");
    }
  }
  return options;
}

void make_ideal(sim::Scene& scene) {
  scene.camera.is_ideal = true;
  scene.tracker = {.rate_hz = scene.tracker.rate_hz,
                   .position_noise_m = 0.0,
                   .attitude_noise_rad = 0.0,
                   .drift_m_per_sqrt_s = 0.0,
                   .yaw_drift_rad_per_sqrt_s = 0.0,
                   .medium_after_s = 0.0,
                   .high_after_s = 0.0,
                   .jump = std::nullopt};
}

/// The instruments' clocks start at 0 when the rig is switched on.
class SimSource final : public FrameSource {
 public:
  SimSource(SourceInfo info, const sim::Scene& scene, Nanoseconds start, sim::RayCaster world,
            sim::StereoCamera camera)
      : info_(std::move(info)),
        rate_hz_(scene.camera.rate_hz),
        start_(start),
        flight_(scene.flight),
        world_(std::move(world)),
        camera_(std::move(camera)),
        tracker_(scene.tracker, scene.seed, scene.flight, scene.T_body_camera, start),
        rig_({.cameras = {{.T_body_camera = scene.T_body_camera}},
              .poses = {.track = {}, .gates = {.min_confidence = kMediumConfidence}}}) {}

  Expected<std::optional<Frame>> next() override {
    while (true) {
      if (auto frame = rig_.pop()) return frame;
      if (is_over_) return std::nullopt;
      advance();
    }
  }
  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return rig_.tally(); }

 private:
  [[nodiscard]] Stamp image_stamp() const {
    return {std::llround(static_cast<double>(images_) * 1e9 / rate_hz_)};
  }

  /// Lets whichever instrument comes next in time deliver one reading.
  void advance() {
    const bool has_image = images_ < *info_.frame_count;
    if (has_image && image_stamp() < tracker_.next_stamp()) {
      take_image();
    } else {
      take_pose();
      // The pose after the last image closes the bracket around it.
      is_over_ = !has_image;
      if (is_over_) rig_.finish();
    }
  }

  void take_image() {
    const Stamp stamp = image_stamp();
    const Nanoseconds flown = start_ + Nanoseconds(stamp.ns);
    world_.move_to(flown);
    rig_.push(DepthFrame{stamp, camera_.capture(world_, flight_.camera_at(flown), images_),
                         camera_.intrinsics()});
    ++images_;
  }

  void take_pose() {
    const sim::RawTrackerPose raw = tracker_.next();
    PoseSample pose = from_t265(raw.stamp, raw.R_raw, raw.t_raw_m, raw.confidence);
    const auto& T_scene_tracker = tracker_.T_scene_tracker();
    pose.R_world_body = T_scene_tracker.rotation() * pose.R_world_body;
    pose.t_world_body_m = T_scene_tracker * pose.t_world_body_m;
    rig_.push(pose);
  }

  SourceInfo info_;
  double rate_hz_;
  Nanoseconds start_;
  sim::Flight flight_;
  sim::RayCaster world_;
  sim::StereoCamera camera_;
  sim::Tracker tracker_;
  Rig rig_;
  std::size_t images_ = 0;
  bool is_over_ = false;
};

}  // namespace

Expected<FrameSourcePtr> open_sim_source(std::string_view rest) {
  const std::size_t mark = std::min(rest.find('?'), rest.size());
  auto options = parse_options(rest.substr(std::min(mark + 1, rest.size())));
  if (!options) return forward_error(std::move(options));
  auto scene = sim::load_scene(rest.substr(0, mark));
  if (!scene) return forward_error(std::move(scene));
  const Nanoseconds left = scene->flight.duration() - options->start;
  if (left < Nanoseconds(0)) {
    return fail(ErrorCode::kUsage, "sim", "start lies behind the end of the flight",
                fmt::format("the flight takes {:.1f} s", seconds(scene->flight.duration())));
  }
  scene->seed = options->seed.value_or(scene->seed);
  if (!options->has_noise) make_ideal(*scene);

  auto world = sim::RayCaster::create(*scene);
  if (!world) return forward_error(std::move(world));
  auto camera = sim::StereoCamera::create(scene->camera, scene->seed);
  if (!camera) return forward_error(std::move(camera));

  const auto images = static_cast<std::size_t>(seconds(left) * scene->camera.rate_hz + 1e-6) + 1;
  SourceInfo info{"sim:" + std::string(rest), "+y",
                  std::min(images, options->frames.value_or(images)), scene->camera.baseline_m};
  return std::make_unique<SimSource>(std::move(info), *scene, options->start, *std::move(world),
                                     *std::move(camera));
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_EMBREE
