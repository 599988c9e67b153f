// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/integrate/cube_view.hpp"
#include "swiftlet/integrate/evidence_table.hpp"
#include "swiftlet/integrate/silhouette.hpp"
#include "swiftlet/integrate/step_rounding.hpp"

namespace swiftlet {

/// What the readings in the image of one cell say about it: the same sum as over the rays that
/// cross it, taken from the cell's side (method 6).
class FootprintEvidence {
 public:
  FootprintEvidence(const CubeView& view, const Image<std::uint16_t>& raw,
                    const EvidenceTable& table, const StereoSensor& sensor,
                    double logodds_per_step);

  /// Evidence of a cell that may hold a surface, missing readings, or the edge of the image.
  [[nodiscard]] FixedSteps of_cell(const CubeInView& cell) const;

  /// Evidence of a cell that every ray with a reading passes; some pixels have none.
  [[nodiscard]] FixedSteps of_seen_cell(const CubeInView& cell) const;

  /// Evidence of a cell that every ray through it passes.
  [[nodiscard]] FixedSteps of_free_cell(const Float3& p_world, float z) const {
    return static_cast<FixedSteps>(view_.observations(p_world, z) * free_steps_);
  }

  /// Nearer than this [m], the number of rays through a cell is counted instead of computed.
  [[nodiscard]] float counting_m() const { return kCountingCells * view_.voxel_m(); }

 private:
  static constexpr float kCountingCells = 4.0F;

  struct Samples {
    std::int32_t log_odds = 0;  // sum of EvidenceTable values
    std::int32_t rays = 0;      // samples whose ray crosses the cell
  };
  template <class AddRun>
  Samples sample(const CubeInView& cell, const Silhouette& silhouette, AddRun&& add_run) const;
  [[nodiscard]] Samples nearest(const CubeInView& cell, const Silhouette& silhouette) const;
  [[nodiscard]] FixedSteps mean_of(const CubeInView& cell, const Samples& samples) const;
  [[nodiscard]] FixedSteps counted(const CubeInView& cell) const;

  [[nodiscard]] ReadingQuery query_for(const CubeInView& cell, const Silhouette& silhouette) const;

  const CubeView& view_;
  const Image<std::uint16_t>& raw_;
  const EvidenceTable& table_;
  float half_voxel_m_;
  float weight_per_z2_;  // DW = z^2 times this
  float steps_per_one_;  // FixedSteps per unit of the table
  float free_steps_;
  ReadingQuery query_{};  // all but the cell
};

}  // namespace swiftlet
