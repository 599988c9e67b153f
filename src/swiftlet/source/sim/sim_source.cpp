// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim/sim_source.hpp"

#if SWIFTLET_HAS_EMBREE

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/stereo_camera.hpp"
#include "swiftlet/sim/tracker/pose_faults.hpp"
#include "swiftlet/sim/tracker/tracker.hpp"
#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/t265_axes.hpp"
#include "swiftlet/source/sim/sim_flight.hpp"

namespace swiftlet {
namespace {

/// The scene with its instruments, as one rig has them.
struct SimWorld {
  SimFlight flight;
  sim::RayCaster world;
  std::vector<sim::StereoCamera> cameras;
  sim::PoseFaults faults;
};

/// The instruments' clocks start at 0 when the rig is switched on. Cameras run at the same rate,
/// one after the other.
class SimSource final : public FrameSource {
 public:
  SimSource(SourceInfo info, SimWorld sim)
      : info_(std::move(info)),
        sim_(std::move(sim)),
        tracker_({scene().tracker, scene().seed, scene().flight, scene().T_body_camera,
                  sim_.flight.options.start},
                 sim_.faults, scene().seed),
        rig_(sim_.flight.options.rig) {}

  Expected<std::optional<Frame>> next() override {
    while (true) {
      if (auto frame = rig_.pop()) return frame;
      if (is_over_ || (is_unwanted_ && is_unwanted_())) return std::nullopt;
      advance();
    }
  }
  const SourceInfo& info() const override { return info_; }
  const FrameTally& tally() const override { return rig_.tally(); }
  const RigStatistics* statistics() const override { return &rig_.statistics(); }
  const RigOptions* rig() const override { return &rig_.options(); }
  void stop_when(const std::function<bool()>& is_unwanted) override { is_unwanted_ = is_unwanted; }

 private:
  /// The n-th image to arrive.
  struct Shot {
    std::uint64_t number;  // of its camera
    std::size_t camera;
    Stamp stamp;
    Stamp arrival;
  };
  [[nodiscard]] const sim::Scene& scene() const { return sim_.flight.scene; }
  [[nodiscard]] Stamp tick(std::size_t n) const {
    const double rate_hz = scene().camera.rate_hz * static_cast<double>(sim_.cameras.size());
    return {std::llround(static_cast<double>(n) * 1e9 / rate_hz)};
  }
  [[nodiscard]] Shot shot(std::size_t n) const {
    const std::size_t count = sim_.cameras.size();
    const std::size_t period = n / count;
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (const auto shuffle = sim_.flight.options.shuffle) {
      std::mt19937_64 random(mix_bits(*shuffle + period));
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
    sim_.world.move_to(sim_.flight.flown(shot.stamp));
    const auto T_world_camera = sim_.flight.true_pose(shot.stamp, shot.camera);
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
  sim::FaultyTracker tracker_;
  Rig rig_;
  std::function<bool()> is_unwanted_;
  std::size_t images_ = 0;
  Stamp newest_image_, newest_pose_;
  bool is_over_ = false;
};

/// Sets what goes wrong, if anything is asked to.
Status apply_fault(SimWorld& sim) {
  const SimOptions& options = sim.flight.options;
  if (!options.fault) return Done{};
  auto fault = find_registered(sim::pose_faults(), *options.fault, "fault");
  if (!fault) return forward_error(std::move(fault));
  fault->make(options.fault_at, sim.flight.scene.tracker, sim.faults);
  return Done{};
}

Expected<SimWorld> build_world(SimFlight flight) {
  auto world = sim::RayCaster::create(flight.scene);
  if (!world) return forward_error(std::move(world));
  SimWorld sim{std::move(flight), std::move(*world), {}, {}};
  const std::vector<RigCamera>& rig = sim.flight.options.rig.cameras;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    sim::StereoOptions instrument = sim.flight.scene.camera;
    const double baseline_m = rig[i].baseline_m;
    if (baseline_m > 0.0) instrument.baseline_m = baseline_m;
    // Cameras of one rig have different noise.
    auto camera = sim::StereoCamera::create(instrument, sim.flight.scene.seed + 0x9E37 * i);
    if (!camera) return forward_error(std::move(camera));
    sim.cameras.push_back(std::move(*camera));
  }
  if (auto applied = apply_fault(sim); !applied) return forward_error(std::move(applied));
  return sim;
}

}  // namespace

Expected<FrameSourcePtr> open_sim_source(std::string_view rest) {
  auto flight = read_sim_flight(rest);
  if (!flight) return forward_error(std::move(flight));
  const sim::Scene& scene = flight->scene;
  RigOptions& rig = flight->options.rig;
  // Within a period the images of several cameras may arrive in any order.
  rig.reorder_window =
      std::max(rig.reorder_window, Nanoseconds(std::llround(1.001e9 / scene.camera.rate_hz)));
  const Nanoseconds left = scene.flight.duration() - flight->options.start;
  const auto rounds = static_cast<std::size_t>(seconds(left) * scene.camera.rate_hz + 1e-6) + 1;
  const std::size_t images = rounds * rig.cameras.size();
  SourceInfo info{"sim:" + std::string(rest),
                  "+y",
                  std::min(images, flight->options.frames.value_or(images)),
                  scene.camera.baseline_m,
                  {IntrinsicsOrigin::kSimulator, {}}};
  auto sim = build_world(std::move(*flight));
  if (!sim) return forward_error(std::move(sim));
  return std::make_unique<SimSource>(std::move(info), std::move(*sim));
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_EMBREE
