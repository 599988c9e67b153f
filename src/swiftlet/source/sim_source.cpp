// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim_source.hpp"

#if SWIFTLET_HAS_EMBREE

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/sim/pose_faults.hpp"
#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/sim/stereo_camera.hpp"
#include "swiftlet/sim/tracker.hpp"
#include "swiftlet/source/rig.hpp"
#include "swiftlet/source/sim_options.hpp"
#include "swiftlet/source/t265_axes.hpp"

namespace swiftlet {
namespace {

/// The scene's camera, and others like it, evenly around the body.
void place_cameras(const sim::Scene& scene, std::size_t count, RigOptions& rig) {
  const RigCamera first = rig.cameras.front();
  rig.cameras.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const double yaw_rad =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const auto turn = Transform<Body, Body>::trusted(sim::rotation_from_ypr(yaw_rad, 0.0, 0.0),
                                                     Eigen::Vector3d::Zero());
    RigCamera camera = first;
    camera.name = fmt::format("camera{}", i);
    camera.T_body_camera = i == 0 ? scene.T_body_camera : turn * scene.T_body_camera;
    rig.cameras.push_back(std::move(camera));
  }
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

/// The scene with its instruments, as one rig has them.
struct SimWorld {
  sim::Scene scene;
  sim::RayCaster world;
  std::vector<sim::StereoCamera> cameras;
  sim::PoseFaults faults;
};

/// The instruments' clocks start at 0 when the rig is switched on. Cameras run at the same rate,
/// one after the other.
class SimSource final : public FrameSource {
 public:
  SimSource(SourceInfo info, SimWorld sim, const SimOptions& options)
      : info_(std::move(info)),
        sim_(std::move(sim)),
        start_(options.start),
        shuffle_(options.shuffle),
        tracker_({sim_.scene.tracker, sim_.scene.seed, sim_.scene.flight, sim_.scene.T_body_camera,
                  options.start},
                 sim_.faults, sim_.scene.seed),
        rig_(options.rig) {
    for (const RigCamera& camera : options.rig.cameras)
      T_flown_camera_.push_back(sim_.scene.T_body_camera.inverse() * camera.T_body_camera);
  }

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
  /// The n-th image to arrive.
  struct Shot {
    std::uint64_t number;  // of its camera
    std::size_t camera;
    Stamp stamp;
    Stamp arrival;
  };
  [[nodiscard]] Stamp tick(std::size_t n) const {
    const double rate_hz = sim_.scene.camera.rate_hz * static_cast<double>(sim_.cameras.size());
    return {std::llround(static_cast<double>(n) * 1e9 / rate_hz)};
  }
  [[nodiscard]] Shot shot(std::size_t n) const {
    const std::size_t count = sim_.cameras.size();
    const std::size_t period = n / count;
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (shuffle_) {
      std::mt19937_64 random(mix_bits(*shuffle_ + period));
      std::ranges::shuffle(order, random);
    }
    const std::size_t camera = order[n % count];
    return {period, camera, tick(period * count + camera), tick(n)};
  }

  /// Lets whichever instrument comes next in time deliver one reading.
  void advance() {
    const auto pose_arrival = tracker_.next_arrival();
    if (images_ < *info_.frame_count) {
      const Shot next = shot(images_);
      if (pose_arrival && *pose_arrival <= next.arrival) return take_pose();
      return take_image(next);
    }
    // The first pose after the last image closes the bracket around it.
    if (pose_arrival && newest_pose_ < newest_image_ + kLongestOffset) return take_pose();
    rig_.finish();
    is_over_ = true;
  }

  void take_image(const Shot& shot) {
    const Nanoseconds flown = start_ + Nanoseconds(shot.stamp.ns);
    sim_.world.move_to(flown);
    auto T_world_camera = sim_.scene.flight.camera_at(flown);
    if (shot.camera > 0 || sim_.cameras.size() > 1)
      T_world_camera = T_world_camera * T_flown_camera_[shot.camera];
    sim::StereoCamera& camera = sim_.cameras[shot.camera];
    rig_.push(DepthFrame{shot.stamp, camera.capture(sim_.world, T_world_camera, shot.number),
                         camera.intrinsics(), to<std::uint8_t>(shot.camera)});
    newest_image_ = std::max(newest_image_, shot.stamp);
    ++images_;
  }

  void take_pose() {
    const sim::RawTrackerPose raw = tracker_.next();
    newest_pose_ = std::max(newest_pose_, raw.stamp);
    PoseSample pose = from_t265(raw.stamp, raw.R_raw, raw.t_raw_m, raw.confidence);
    const auto& T_scene_tracker = tracker_.tracker().T_scene_tracker();
    pose.R_world_body = T_scene_tracker.rotation() * pose.R_world_body;
    pose.t_world_body_m = T_scene_tracker * pose.t_world_body_m;
    rig_.push(pose);
  }

  static constexpr Nanoseconds kLongestOffset = std::chrono::milliseconds(50);

  SourceInfo info_;
  SimWorld sim_;
  Nanoseconds start_;
  std::optional<std::uint64_t> shuffle_;
  std::vector<Transform<Camera, Camera>> T_flown_camera_;  // by camera: the scene's is flown
  sim::FaultyTracker tracker_;
  Rig rig_;
  std::size_t images_ = 0;
  Stamp newest_image_, newest_pose_;
  bool is_over_ = false;
};

/// Sets what goes wrong, if anything is asked to.
Status apply_fault(const SimOptions& options, SimWorld& sim) {
  if (!options.fault) return Done{};
  auto fault = find_registered(sim::pose_faults(), *options.fault, "fault");
  if (!fault) return forward_error(std::move(fault));
  fault->make(options.fault_at, sim.scene.tracker, sim.faults);
  return Done{};
}

Expected<SimWorld> build_world(sim::Scene scene, const SimOptions& options) {
  auto world = sim::RayCaster::create(scene);
  if (!world) return forward_error(std::move(world));
  SimWorld sim{std::move(scene), std::move(*world), {}, {}};
  for (std::size_t i = 0; i < options.rig.cameras.size(); ++i) {
    sim::StereoOptions instrument = sim.scene.camera;
    const double baseline_m = options.rig.cameras[i].baseline_m;
    if (baseline_m > 0.0) instrument.baseline_m = baseline_m;
    // Cameras of one rig have different noise.
    auto camera = sim::StereoCamera::create(instrument, sim.scene.seed + 0x9E37 * i);
    if (!camera) return forward_error(std::move(camera));
    sim.cameras.push_back(std::move(*camera));
  }
  if (auto applied = apply_fault(options, sim); !applied) return forward_error(std::move(applied));
  return sim;
}

}  // namespace

Expected<FrameSourcePtr> open_sim_source(std::string_view rest) {
  auto address = parse_address(rest, "sim");
  if (!address) return forward_error(std::move(address));
  auto options = parse_sim_options(*address);
  if (!options) return forward_error(std::move(options));
  auto scene = sim::load_scene(address->place);
  if (!scene) return forward_error(std::move(scene));
  const Nanoseconds left = scene->flight.duration() - options->start;
  if (left < Nanoseconds(0)) {
    return fail(ErrorCode::kUsage, "sim", "start lies behind the end of the flight",
                fmt::format("the flight takes {:.1f} s", seconds(scene->flight.duration())));
  }
  scene->seed = options->seed.value_or(scene->seed);
  if (!options->has_noise) make_ideal(*scene);
  if (!options->rig_file) place_cameras(*scene, options->cameras, options->rig);

  const std::size_t cameras = options->rig.cameras.size();
  // Within a period the images of several cameras may arrive in any order.
  options->rig.reorder_window = std::max(
      options->rig.reorder_window, Nanoseconds(std::llround(1.001e9 / scene->camera.rate_hz)));
  const auto rounds = static_cast<std::size_t>(seconds(left) * scene->camera.rate_hz + 1e-6) + 1;
  const std::size_t images = rounds * cameras;
  SourceInfo info{"sim:" + std::string(rest), "+y",
                  std::min(images, options->frames.value_or(images)), scene->camera.baseline_m};
  auto sim = build_world(std::move(*scene), *options);
  if (!sim) return forward_error(std::move(sim));
  return std::make_unique<SimSource>(std::move(info), std::move(*sim), *options);
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_EMBREE
