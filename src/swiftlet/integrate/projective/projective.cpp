// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <vector>

#include "swiftlet/base/worker_team.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/projective/block_evidence.hpp"
#include "swiftlet/integrate/projective/view_calculator.hpp"

namespace swiftlet {
namespace {

using Clock = std::chrono::steady_clock;

/// Readings of a tile that lie farther apart than this, in voxels, are on two sides of an edge.
constexpr float kMostScatter = 0.35F;

/// The same sum as the rays', from the voxel's side (method 6): every voxel in view looks up the
/// readings in its image.
///
/// Threads share the cubes of the window, nearest first. Each works out new blocks aside; they go
/// into the map when all are done, so a block depends on the frame and on itself alone.
class ProjectiveIntegrator final : public Integrator {
 public:
  explicit ProjectiveIntegrator(const IntegrateOptions& options)
      : logodds_per_step_(options.logodds_per_step),
        limit_(options.max_frame_ms),
        team_(options.threads),
        workers_(static_cast<std::size_t>(options.threads)) {}

  [[nodiscard]] int threads() const { return team_.threads(); }

  [[nodiscard]] std::size_t memory_bytes() const override {
    std::size_t bytes = means_.memory_bytes() + frustum_.memory_bytes();
    for (const Worker& w : workers_) bytes += sizeof w + w.updates.capacity() * sizeof(BlockUpdate);
    return bytes;
  }

 private:
  IntegrationTally fuse(const DepthView& view, const StereoSensor& sensor, MeasurementModel& model,
                        RollingMap& map) override {
    const Clock::time_point start = Clock::now();
    IntegrationTally tally;
    tally.readings = view.pyramid.readings();
    if (tally.readings == 0) return tally;
    const CubeView cubes(view, map.voxel_m());
    const float unit_m = view.depth.unit_m;
    const float farthest_m = unit_m * static_cast<float>(view.pyramid.farthest());
    const KernelParams params = kernel_params(
        view_params(cubes, unit_m), model.prepare(cubes, farthest_m), sensor, logodds_per_step_);
    means_.build(view.depth.raw,
                 {.unit_m = unit_m,
                  .sigma_per_z2 = params.sigma_per_z2,
                  .most_scatter_m = kMostScatter * cubes.voxel_m(),
                  .frame_number = view.frame_number},
                 team_);
    const FrameEvidence frame(cubes, view, means_, model, params);
    frustum_.find(map.window(), cubes, frame);
    tally.blocks_left = update_blocks(cubes, frame, map, start);
    commit(map, tally);
    return tally;
  }

  /// Works out the new blocks, until it is late. Returns how many blocks in view are left out.
  std::size_t update_blocks(const CubeView& cubes, const FrameEvidence& frame,
                            const RollingMap& map, Clock::time_point start) {
    std::atomic<std::size_t> next{0};
    team_.run([&](int worker) {
      Worker& w = workers_[static_cast<std::size_t>(worker)];
      w.updates.clear();
      while (!is_late(start)) {
        const std::size_t mine = next.fetch_add(1, std::memory_order_relaxed);
        if (mine >= frustum_.size()) break;
        frustum_.for_each_block(mine, cubes, frame, [&](const BlockIndex& index, UpdateType type) {
          w.update(index, type, frame, map);
        });
      }
    });
    std::size_t left = 0;
    for (std::size_t i = std::min<std::size_t>(next, frustum_.size()); i < frustum_.size(); ++i)
      left += frustum_.blocks_of(i);
    return left;
  }

  struct BlockUpdate {
    VoxelBlock block;
    BlockIndex index;
    std::size_t voxels;
  };
  struct Worker {
    std::vector<BlockUpdate> updates;
    BlockEvidence evidence;

    void update(const BlockIndex& index, UpdateType type, const FrameEvidence& frame,
                const RollingMap& map) {
      const VoxelBlock* known = map.find(index);
      if (!frame.collect(index, type, known, evidence)) return;
      BlockUpdate& u = updates.emplace_back();
      u.index = index;
      if (known == nullptr) {
        u.block.clear();
      } else {
        u.block = *known;
      }
      u.voxels = add_evidence(evidence.steps, rounding_seed(index, frame.frame_number()), u.block);
    }
  };

  [[nodiscard]] bool is_late(Clock::time_point start) const {
    return limit_.count() > 0.0 && Clock::now() - start > limit_;
  }

  void commit(RollingMap& map, IntegrationTally& tally) {
    for (const Worker& w : workers_) {
      for (const BlockUpdate& u : w.updates) {
        map.writable(u.index) = u.block;
        tally.voxels += u.voxels;
      }
      tally.blocks += w.updates.size();
    }
  }

  double logodds_per_step_;
  std::chrono::duration<double, std::milli> limit_;
  WorkerTeam team_;
  DepthMeanPyramid means_;
  ViewCalculator frustum_;
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
