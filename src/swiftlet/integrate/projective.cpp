// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <array>
#include <cmath>

#include "swiftlet/integrate/depth_pyramid.hpp"
#include "swiftlet/integrate/evidence_table.hpp"
#include "swiftlet/integrate/footprint_evidence.hpp"
#include "swiftlet/integrate/integrator.hpp"

namespace swiftlet {
namespace {

/// What a frame can say about a cube of cells.
enum class Verdict { kNothing, kFree, kFreeWithHoles, kMixed };

bool is_free(Verdict v) { return v == Verdict::kFree || v == Verdict::kFreeWithHoles; }

/// Evidence of one frame, cube by cube: where the depth image says the same about all of a cube,
/// its cells get it at once; elsewhere the cube is halved, down to single cells.
class FrameEvidence {
 public:
  FrameEvidence(const CubeView& view, const DepthPyramid& pyramid, const EvidenceTable& table,
                const FootprintEvidence& footprints)
      : view_(view), pyramid_(pyramid), table_(table), footprints_(footprints) {
    const Float3& a = view.optical_axis();
    const float across = std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
    // From the nearest point of a cell's cube to the nearest of its slice of depth.
    slice_inset_m_ = 0.5F * view.voxel_m() * (across - 1.0F);
  }

  [[nodiscard]] Verdict judge(const CubeInView& cube) const {
    if (cube.z_near() < 0.5F * view_.voxel_m())
      return view_.meets_frustum(cube) ? Verdict::kMixed : Verdict::kNothing;
    const Footprint f = view_.footprint(cube);
    if (!view_.meets_image(f)) return Verdict::kNothing;
    const DepthRange range = pyramid_.range_of(view_.pixels(f));
    if (!range.has_readings()) return Verdict::kNothing;
    if (cube.z_near() + slice_inset_m_ > table_.reach_m(range.farthest)) return Verdict::kNothing;
    const bool is_clear = cube.z_near() > footprints_.counting_m() &&
                          cube.z_far() - slice_inset_m_ < table_.clear_m(range);
    if (!is_clear) return Verdict::kMixed;
    return range.is_complete() && view_.is_inside_image(f) ? Verdict::kFree
                                                           : Verdict::kFreeWithHoles;
  }

  /// The block that comes next, as the map has it; null if it holds nothing yet.
  void begin_block(const VoxelBlock* known) { known_ = known; }

  /// Whether the cells of a cube are all surely free: more free evidence changes none of them.
  [[nodiscard]] bool is_surely_free(int edge, std::size_t offset) const {
    if (known_ == nullptr) return false;
    for (int z = 0; z < edge; ++z) {
      unsigned any = 0;
      for (int y = 0; y < edge; ++y) {
        const LogOdds* row = &known_->cells[offset + kBlockEdge * (y + kBlockEdge * z)];
        for (int x = 0; x < edge; ++x) any |= row[x];
      }
      if (any != kFreeCell) return false;
    }
    return true;
  }

  /// Fills the evidence of a cube of `edge` cells whose first has this offset in its block.
  void descend(const CubeInView& cube, int edge, std::size_t offset, FixedSteps* evidence) const {
    if (edge == 1) {
      evidence[offset] = footprints_.of_cell(cube);
      return;
    }
    for_each_part(cube, edge, offset, [&](const CubeInView& part, std::size_t part_offset) {
      const Verdict verdict = judge(part);
      if (is_free(verdict) && is_surely_free(edge / 2, part_offset)) return;
      switch (verdict) {
        case Verdict::kNothing:
          break;
        case Verdict::kFree:
          fill_free(part, edge / 2, part_offset, evidence);
          break;
        case Verdict::kFreeWithHoles:
          fill_seen(part, edge / 2, part_offset, evidence);
          break;
        case Verdict::kMixed:
          descend(part, edge / 2, part_offset, evidence);
          break;
      }
    });
  }

  /// Every cell is free as far as it is seen. Complete parts of it are still told apart while that
  /// saves looking at each cell.
  void fill_seen(const CubeInView& cube, int edge, std::size_t offset, FixedSteps* evidence) const {
    if (edge == 1) {
      evidence[offset] = footprints_.of_seen_cell(cube);
      return;
    }
    for_each_part(cube, edge, offset, [&](const CubeInView& part, std::size_t part_offset) {
      if (is_surely_free(edge / 2, part_offset)) return;
      const Verdict verdict = edge > 2 ? judge(part) : Verdict::kFreeWithHoles;
      if (verdict == Verdict::kNothing) return;
      if (verdict == Verdict::kFree) {
        fill_free(part, edge / 2, part_offset, evidence);
      } else {
        fill_seen(part, edge / 2, part_offset, evidence);
      }
    });
  }

  void fill_free(const CubeInView& cube, int edge, std::size_t offset, FixedSteps* evidence) const {
    const float step = view_.voxel_m(), first = -0.5F * static_cast<float>(edge - 1) * step;
    const auto at = [&](int axis, int i) {
      return cube.p_world[axis] + first + static_cast<float>(i) * step;
    };
    for (int z = 0; z < edge; ++z) {
      for (int y = 0; y < edge; ++y) {
        FixedSteps* row = evidence + offset + kBlockEdge * (y + kBlockEdge * z);
        for (int x = 0; x < edge; ++x) {
          const Float3 p{at(0, x), at(1, y), at(2, z)};
          row[x] = footprints_.of_free_cell(p, dot(view_.optical_axis(), p));
        }
      }
    }
  }

 private:
  template <class Visit>
  void for_each_part(const CubeInView& cube, int edge, std::size_t offset, Visit&& visit) const {
    const int half = edge / 2;
    for (int i = 0; i < 8; ++i) {
      const int x = i & 1, y = (i >> 1) & 1, z = i >> 2;
      visit(view_.child(cube, half, x, y, z),
            offset + static_cast<std::size_t>(half * (x + kBlockEdge * (y + kBlockEdge * z))));
    }
  }

  const CubeView& view_;
  const DepthPyramid& pyramid_;
  const EvidenceTable& table_;
  const FootprintEvidence& footprints_;
  float slice_inset_m_;
  const VoxelBlock* known_ = nullptr;
};

/// The same sum as the rays', from the cell's side (method 6): every cell in view looks up the
/// readings in its image.
class ProjectiveIntegrator final : public Integrator {
 public:
  explicit ProjectiveIntegrator(double logodds_per_step) : logodds_per_step_(logodds_per_step) {}

  IntegrationTally integrate(const DepthView& view, const StereoSensor& sensor,
                             RollingMap& map) override {
    IntegrationTally tally;
    const Image<std::uint16_t>& raw = view.depth.raw;
    tally.readings = raw.pixels().size() -
                     static_cast<std::size_t>(std::ranges::count(raw.pixels(), std::uint16_t{0}));
    pyramid_.build(raw);
    if (!pyramid_.range().has_readings()) return tally;
    table_.prepare(sensor, view.depth.unit_m, pyramid_.range().farthest);
    const CubeView cubes(view, map.voxel_m());
    const FootprintEvidence footprints(cubes, raw, table_, sensor, logodds_per_step_);
    FrameEvidence frame(cubes, pyramid_, table_, footprints);

    for_each_block(map.window(), [&](const BlockIndex& index) {
      const CubeInView cube = cubes.cube(first_voxel(index), kBlockEdge);
      const Verdict verdict = frame.judge(cube);
      if (verdict == Verdict::kNothing) return;
      frame.begin_block(map.find(index));
      if (is_free(verdict) && frame.is_surely_free(kBlockEdge, 0)) return;
      if (verdict == Verdict::kFree) {
        frame.fill_free(cube, kBlockEdge, 0, evidence_.data());
      } else {
        evidence_.fill(0);
        frame.descend(cube, kBlockEdge, 0, evidence_.data());
        if (std::ranges::all_of(evidence_, [](FixedSteps e) { return e == 0; })) return;
      }
      tally.cells +=
          add_evidence(evidence_, rounding_seed(index, view.frame_number), map.writable(index));
      ++tally.blocks;
    });
    return tally;
  }

  [[nodiscard]] std::size_t memory_bytes() const override {
    return pyramid_.memory_bytes() + table_.memory_bytes();
  }

 private:
  double logodds_per_step_;
  DepthPyramid pyramid_;
  EvidenceTable table_;
  std::array<FixedSteps, kBlockVoxels> evidence_{};  // of one block
};

}  // namespace

Expected<std::unique_ptr<Integrator>> make_projective(const IntegrateOptions& options) {
  return std::make_unique<ProjectiveIntegrator>(options.logodds_per_step);
}

}  // namespace swiftlet
