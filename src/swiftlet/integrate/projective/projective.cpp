// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <vector>

#include "swiftlet/base/worker_team.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/projective/block_evidence.hpp"
#include "swiftlet/integrate/projective/view_calculator.hpp"

namespace swiftlet {
namespace {

using Clock = std::chrono::steady_clock;

/// Readings of a tile that lie farther apart than this, in cells, are on two sides of an edge.
constexpr float kMostScatter = 0.35F;

KernelParams look(const CubeView& view, const StereoSensor& sensor, const EvidenceTable& table,
                  float unit_m, float steps_per_log_odds) {
  const Float3& a = view.optical_axis();
  const float across_cells = std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
  // From the nearest point of a cell's cube to the nearest of its slice.
  const float inset_m = 0.5F * view.voxel_m() * (across_cells - 1.0F);
  const bool has_chords = sensor.shape() == CellShape::kChord;
  const auto free_log_odds = static_cast<float>(sensor.model().free_log_odds());
  const auto sigma_per_z2 = static_cast<float>(sensor.noise().sigma_m(1.0));
  return {.world_axis = view.world_axis(),
          .fx = view.fx(),
          .fy = view.fy(),
          .u_offset = view.cx() + 0.5F,
          .v_offset = view.cy() + 0.5F,
          .width = static_cast<float>(view.width()),
          .height = static_cast<float>(view.height()),
          .voxel_m = view.voxel_m(),
          .has_chords = has_chords,
          .hidden_m = has_chords ? ChordModel::kHidingCells * view.voxel_m() : -inset_m,
          .passed_m = has_chords ? ChordModel::kEndCells * view.voxel_m() : -inset_m,
          .clear_m = has_chords ? ChordModel::kClearCells * view.voxel_m() : -inset_m,
          .reach_sigma = has_chords ? ChordModel::kFadeSigma : EvidenceTable::kReachSigma,
          .unit_m = unit_m,
          .sigma_per_z2 = sigma_per_z2,
          .per_sigma = 1.0F / sigma_per_z2,
          .model = table.log_odds(),
          .steps_per_log_odds = steps_per_log_odds,
          .free_log_odds = free_log_odds,
          .clear_log_odds = (has_chords ? ChordModel::kClearGain : 1.0F) * free_log_odds};
}

/// The same sum as the rays', from the cell's side (method 6): every cell in view looks up the
/// readings in its image.
///
/// Threads share the cubes of the window, nearest first. Each works out new blocks aside; they go
/// into the map when all are done, so a block depends on the frame and on itself alone.
class ProjectiveIntegrator final : public Integrator {
 public:
  explicit ProjectiveIntegrator(const IntegrateOptions& options)
      : steps_per_log_odds_(static_cast<float>(kOneStep / options.logodds_per_step)),
        limit_(options.max_frame_ms),
        team_(options.threads),
        workers_(static_cast<std::size_t>(options.threads)) {}

  [[nodiscard]] int threads() const { return team_.threads(); }

  IntegrationTally integrate(const DepthView& view, const StereoSensor& sensor,
                             RollingMap& map) override {
    const Clock::time_point start = Clock::now();
    IntegrationTally tally;
    tally.readings = view.pyramid.readings();
    if (tally.readings == 0) return tally;
    const CubeView cubes(view, map.voxel_m());
    const float unit_m = view.depth.unit_m;
    if (sensor.shape() == CellShape::kSlice)
      table_.prepare(sensor, cubes.voxel_m(), unit_m * static_cast<float>(view.pyramid.farthest()));
    const KernelParams in_view = look(cubes, sensor, table_, unit_m, steps_per_log_odds_);
    means_.build(view.depth.raw,
                 {.unit_m = unit_m,
                  .sigma_per_z2 = in_view.sigma_per_z2,
                  .most_scatter_m = kMostScatter * cubes.voxel_m(),
                  .frame_number = view.frame_number},
                 team_);
    const FrameEvidence frame(cubes, view.pyramid, means_, in_view, view.frame_number);

    cubes_.find(map.window(), cubes, frame);
    std::atomic<std::size_t> next{0};
    team_.run([&](int worker) {
      Worker& w = workers_[static_cast<std::size_t>(worker)];
      w.updates.clear();
      while (!is_late(start)) {
        const std::size_t mine = next.fetch_add(1, std::memory_order_relaxed);
        if (mine >= cubes_.size()) break;
        cubes_.for_each_block(mine, cubes, frame, [&](const BlockIndex& index, UpdateType type) {
          w.update(index, type, frame, map, view.frame_number);
        });
      }
    });
    const std::size_t done = std::min<std::size_t>(next, cubes_.size());
    for (std::size_t i = done; i < cubes_.size(); ++i) tally.blocks_left += cubes_.blocks_of(i);
    commit(map, tally);
    return tally;
  }

  [[nodiscard]] std::size_t memory_bytes() const override {
    std::size_t bytes = table_.memory_bytes() + means_.memory_bytes() + cubes_.memory_bytes();
    for (const Worker& w : workers_) bytes += sizeof w + w.updates.capacity() * sizeof(BlockUpdate);
    return bytes;
  }

 private:
  struct BlockUpdate {
    VoxelBlock block;
    BlockIndex index;
    std::size_t cells;
  };
  struct Worker {
    std::vector<BlockUpdate> updates;
    BlockEvidence evidence;

    void update(const BlockIndex& index, UpdateType type, const FrameEvidence& frame,
                const RollingMap& map, std::uint64_t frame_number) {
      const VoxelBlock* known = map.find(index);
      if (!frame.collect(index, type, known, evidence)) return;
      BlockUpdate& u = updates.emplace_back();
      u.index = index;
      if (known == nullptr) {
        u.block.clear();
      } else {
        u.block = *known;
      }
      u.cells = add_evidence(evidence.steps, rounding_seed(index, frame_number), u.block);
    }
  };

  [[nodiscard]] bool is_late(Clock::time_point start) const {
    return limit_.count() > 0.0 && Clock::now() - start > limit_;
  }

  void commit(RollingMap& map, IntegrationTally& tally) {
    for (const Worker& w : workers_) {
      for (const BlockUpdate& u : w.updates) {
        map.writable(u.index) = u.block;
        tally.cells += u.cells;
      }
      tally.blocks += w.updates.size();
    }
  }

  float steps_per_log_odds_;
  std::chrono::duration<double, std::milli> limit_;
  WorkerTeam team_;
  EvidenceTable table_;
  DepthMeanPyramid means_;
  ViewCalculator cubes_;
  std::vector<Worker> workers_;
};

}  // namespace

Expected<std::unique_ptr<Integrator>> make_projective(const IntegrateOptions& options) {
  auto integrator = std::make_unique<ProjectiveIntegrator>(options);
  if (integrator->threads() == options.threads) return integrator;
  return fail(ErrorCode::kOutOfMemory, "integrate.threads",
              fmt::format("the system grants only {} of {} threads", integrator->threads(),
                          options.threads),
              "ask for fewer or raise its limit ('ulimit -u', memory)");
}

}  // namespace swiftlet
