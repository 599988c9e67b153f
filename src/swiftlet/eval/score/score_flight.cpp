// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "swiftlet/eval/score/score_job.hpp"

#if SWIFTLET_HAS_EMBREE

#include "swiftlet/base/progress.hpp"
#include "swiftlet/eval/bench/bench_workload.hpp"
#include "swiftlet/eval/truth/leave_out.hpp"
#include "swiftlet/eval/truth/movers.hpp"
#include "swiftlet/source/sim/sim_flight.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::eval {
namespace {

constexpr std::string_view kKind = "sim:";
/// True views are looked at so often; the maps for phantoms so often.
constexpr Nanoseconds kLookEvery = std::chrono::milliseconds(150);
constexpr Nanoseconds kPhantomsEvery = std::chrono::seconds(1);

/// A map under test, and what was noted of it during the flight.
struct Tested {
  ScoredMap scored;
  Claims claims;  // over the whole truth
  DenseGrid<std::uint8_t> ever_occupied;
  Claims mover_claims;  // where something moves
  Reactions reactions;
};

/// The scene and its true poses.
class FlownWorld {
 public:
  FlownWorld(SimFlight flight, sim::RayCaster caster, const PinholeIntrinsics& intrinsics,
             const PreprocessOptions& range)
      : flight_(std::move(flight)), caster_(std::move(caster)), intrinsics_(intrinsics) {
    sight_.min_range_m = range.min_range_m;
    sight_.max_range_m = range.max_range_m;
  }

  static Expected<FlownWorld> create(const ScoreJob& job) {
    auto flight = read_sim_flight(std::string_view(job.source).substr(kKind.size()));
    if (!flight) return forward_error(std::move(flight));
    auto caster = sim::RayCaster::create(flight->scene);
    if (!caster) return forward_error(std::move(caster));
    const sim::StereoOptions& camera = flight->scene.camera;
    auto intrinsics =
        PinholeIntrinsics::from_field_of_view(camera.width, camera.height, camera.hfov_rad);
    if (!intrinsics) return forward_error(std::move(intrinsics));
    return FlownWorld(std::move(*flight), std::move(*caster), *intrinsics, job.config.depth);
  }

  [[nodiscard]] const sim::Scene& scene() const { return flight_.scene; }

  /// The lines of sight of a camera at a stamp.
  void look(Stamp stamp, std::size_t camera, int stride_px, std::vector<SightLine>& lines) {
    caster_.move_to(flight_.flown(stamp));
    sight_.stride_px = stride_px;
    lines_of_sight(caster_, {intrinsics_, flight_.true_pose(stamp, camera)}, sight_, lines);
  }
  void look_at(Stamp stamp, std::size_t camera, std::vector<ThinVoxel>& voxels) {
    eval::look_at(voxels, caster_, {intrinsics_, flight_.true_pose(stamp, camera)}, sight_);
  }
  [[nodiscard]] std::vector<sim::Object> movers(Stamp stamp) const {
    return movers_at(flight_.scene, flight_.flown(stamp));
  }

  /// All that the flight can see, found by a coarse look.
  Expected<VoxelBox> extent(double voxel_m) {
    constexpr int kCoarse_px = 16;
    constexpr Nanoseconds kStep = std::chrono::milliseconds(250);
    constexpr double kMostVoxels = 6e7;  // some 1 GB for the truth and two maps
    std::vector<SightLine> lines, all;
    for (Nanoseconds t{0}; t <= scene().flight.duration() - flight_.options.start; t += kStep) {
      for (std::size_t i = 0; i < flight_.T_flown_camera.size(); ++i) {
        look({t.count()}, i, kCoarse_px, lines);
        all.insert(all.end(), lines.begin(), lines.end());
      }
    }
    if (all.empty()) {
      return fail(ErrorCode::kCorruptInput, flight_.scene.name, "the flight sees nothing in range",
                  "choose a larger depth.max_range_m");
    }
    const VoxelBox box = box_around(all, voxel_m);
    const double voxels = (box.last.x - box.first.x + 1.0) * (box.last.y - box.first.y + 1.0) *
                          (box.last.z - box.first.z + 1.0);
    if (voxels <= kMostVoxels) return box;
    return fail(ErrorCode::kUsage, flight_.scene.name,
                fmt::format("the flight sees a box of {:.0f} million voxels", 1e-6 * voxels),
                "choose a larger map.voxel_m or a shorter depth.max_range_m");
  }

 private:
  SimFlight flight_;
  sim::RayCaster caster_;
  PinholeIntrinsics intrinsics_;
  SightOptions sight_;
};

VoxelBox bounds_of(const std::vector<VoxelIndex>& voxels) {
  VoxelBox box{{0, 0, 0}, {0, 0, 0}};
  if (voxels.empty()) return box;
  box = {voxels.front(), voxels.front()};
  for (const VoxelIndex& v : voxels) box.include(v);
  return box;
}

/// A flight, with everything that is noted on the way.
class Judge {
 public:
  Judge(FlownWorld world, const VoxelBox& box, double voxel_m, std::vector<ScoredMap> scored_maps)
      : world_(std::move(world)), truth_(world_.scene().objects, voxel_m, box) {
    const auto swept = swept_voxels(world_.scene(), voxel_m, box);
    for (const VoxelIndex& v : swept) truth_.mark_swept(v);
    thin_ = thin_voxels(truth_);
    has_movers_ = !swept.empty();
    const VoxelBox movers = bounds_of(swept);
    sights_ = MoverSights(movers, MoverSight::kNothing);
    for (ScoredMap& scored : scored_maps) {
      tested_.push_back({std::move(scored), Claims(box, Occupancy::kUnknown),
                         DenseGrid<std::uint8_t>(box, 0), Claims(movers, Occupancy::kUnknown),
                         Reactions(movers)});
    }
  }

  void fuse(const Frame& frame) {
    for (Tested& t : tested_) t.scored.map->fuse(frame);
    if (!first_) first_ = frame.stamp;
    last_ = frame.stamp;
    ++frames_;
    const bool is_look_due = !last_look_ || frame.stamp - *last_look_ >= kLookEvery;
    constexpr int kStride_px = 4;
    if (is_look_due || has_movers_) world_.look(frame.stamp, frame.camera, kStride_px, lines_);
    if (is_look_due) {
      last_look_ = frame.stamp;
      for (const SightLine& line : lines_) truth_.add(line);
      world_.look_at(frame.stamp, frame.camera, thin_);
    }
    if (has_movers_) watch_movers(frame.stamp);
    if (last_phantoms_ && frame.stamp - *last_phantoms_ < kPhantomsEvery) return;
    last_phantoms_ = frame.stamp;
    note_occupied();
  }

  ScoreReport judge(const ScoreJob& job) {
    note_occupied();
    ScoreReport report{.source = job.source,
                       .voxel_m = job.config.map.voxel_m,
                       .frames = frames_,
                       .flight_s = first_ ? seconds(last_ - *first_) : 0.0,
                       .maps = {}};
    const Claims* reference = nullptr;
    for (const Tested& t : tested_) {
      report.maps.push_back(t.scored.name);
      if (t.scored.name == kOctomap) reference = &t.claims;
    }
    report.findings.resize(tested_.size());
    for (const auto& score : scores()) {
      for (std::size_t i = 0; i < tested_.size(); ++i) {
        const Tested& t = tested_[i];
        ScoreResult result =
            score.make({truth_, t.claims, t.ever_occupied, reference, report.flight_s, thin_,
                        has_movers_ ? &t.reactions : nullptr});
        for (const ScoreValue& value : result.values)
          add_value(report, i, std::string(score.name), value);
        auto& found = report.findings[i];
        found.insert(found.end(), result.findings.begin(), result.findings.end());
      }
    }
    return report;
  }

 private:
  void note_occupied() {
    for (Tested& t : tested_) {
      t.scored.map->read_claims(t.claims);
      const auto claims = t.claims.voxels();
      const auto ever = t.ever_occupied.voxels();
      for (std::size_t i = 0; i < ever.size(); ++i) {
        if (claims[i] == Occupancy::kOccupied) ever[i] = 1;
      }
    }
  }

  void watch_movers(Stamp stamp) {
    see_movers(world_.movers(stamp), lines_, truth_.voxel_m(), sights_);
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      // The floor that somebody walks on comes and goes with nobody.
      if (truth_.holds_matter(sights_.voxel(i))) sights_.voxels()[i] = MoverSight::kNothing;
    }
    for (Tested& t : tested_) {
      t.scored.map->read_claims(t.mover_claims);
      t.reactions.observe(sights_, t.mover_claims);
    }
  }

  FlownWorld world_;
  Truth truth_;
  std::vector<ThinVoxel> thin_;
  bool has_movers_ = false;
  MoverSights sights_;
  std::vector<Tested> tested_;
  std::vector<SightLine> lines_;  // of the last look
  std::size_t frames_ = 0;
  std::optional<Stamp> first_, last_look_, last_phantoms_;
  Stamp last_;
};

}  // namespace

Expected<ScoreReport> score_flight(const ScoreJob& job) {
  auto source = open_source(job.source);
  if (!source) return forward_error(std::move(source));
  auto scored_maps = make_scored_maps(job);
  if (!scored_maps) return forward_error(std::move(scored_maps));
  auto world = FlownWorld::create(job);
  if (!world) return forward_error(std::move(world));
  const double voxel_m = job.config.map.voxel_m;
  const auto box = world->extent(voxel_m);
  if (!box) return tl::make_unexpected(box.error());
  Judge judge(std::move(*world), *box, voxel_m, std::move(*scored_maps));
  const std::size_t available = (*source)->info().frame_count.value_or(job.frames);
  const std::size_t wanted = std::min(available, job.frames);
  const ProgressTeller shown(job.progress, available);
  std::size_t held = 0;
  while (held < wanted) {
    auto frame = (*source)->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    const std::size_t seen = images_seen((*source)->tally());
    shown.update(seen);
    if (!is_due(seen - 1, held, wanted, available)) continue;
    ++held;
    judge.fuse(**frame);
  }
  return judge.judge(job);
}

}  // namespace swiftlet::eval

#else

namespace swiftlet::eval {

Expected<ScoreReport> score_flight(const ScoreJob& job) {
  return fail(ErrorCode::kUnsupported, job.source, "this build of Swiftlet has no simulated rig",
              "configure with -DSWIFTLET_WITH_EMBREE=ON");
}

}  // namespace swiftlet::eval

#endif
