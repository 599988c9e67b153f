// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/footprint_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace swiftlet {
namespace {

/// A cell's image is looked at in this many of its rows, at least; in all of them if it has fewer.
constexpr int kRows = 48;

/// The whole image is looked at where the camera's plane may cut the cell, in this many rows.
constexpr int kRowsNear = 48;

int stride_of(float height_px, int rows) { return std::max(1, static_cast<int>(height_px) / rows); }

/// Runs of one cell. A stride_of() rounds down, so there are at most twice as many rows and one.
class RunList {
 public:
  void add(const Image<std::uint16_t>& raw, int v, int first, int last) {
    runs_[count_++] = {&raw.at(first, v), last - first + 1, static_cast<float>(first),
                       static_cast<float>(v)};
  }
  [[nodiscard]] std::span<const PixelRun> all() const { return {runs_.data(), count_}; }

 private:
  std::array<PixelRun, 2 * kRowsNear + 2> runs_;
  std::size_t count_ = 0;
};

}  // namespace

FootprintEvidence::FootprintEvidence(const CubeView& view, const Image<std::uint16_t>& raw,
                                     const EvidenceTable& table, const StereoSensor& sensor,
                                     double logodds_per_step)
    : view_(view),
      raw_(raw),
      table_(table),
      half_voxel_m_(0.5F * view.voxel_m()),
      weight_per_z2_(static_cast<float>(sensor.weight(1.0))),
      steps_per_one_(static_cast<float>(kOneStep / logodds_per_step / EvidenceTable::kOne)),
      free_steps_(steps_per_one_ * static_cast<float>(table.free())) {
  table.describe(query_);
  query_.half_voxel = half_voxel_m_;
  query_.image_end = raw.pixels().data() + raw.pixels().size();
}

template <class AddRun>
FootprintEvidence::Samples FootprintEvidence::sample(const CubeInView& cell,
                                                     const Silhouette& silhouette,
                                                     AddRun&& add_run) const {
  const Footprint f = view_.footprint(cell);
  const int stride = stride_of(f.v1 - f.v0, kRows);
  Samples samples;
  // Rays are counted outside the image, too: only the share of the cell that is in view counts.
  const int v_last = static_cast<int>(std::floor(f.v1));
  int v = static_cast<int>(std::ceil(f.v0));
  for (v += (v_last - v) % stride / 2; v <= v_last; v += stride) {
    const Silhouette::Run run = silhouette.run(v, f.u0, f.u1);
    if (run.first > run.last) continue;
    samples.rays += run.last - run.first + 1;
    if (v < 0 || v >= view_.height()) continue;
    const int first = std::max(run.first, 0), last = std::min(run.last, view_.width() - 1);
    if (first <= last) add_run(v, first, last);
  }
  return samples;
}

FixedSteps FootprintEvidence::of_cell(const CubeInView& cell) const {
  const float z = cell.p_camera[2];
  if (z <= 0.0F) return 0;  // the camera's own cell, its centre behind the lens: as the rays do
  if (z < counting_m()) return counted(cell);
  const Silhouette silhouette(view_, cell);
  RunList runs;
  Samples samples =
      sample(cell, silhouette, [&](int v, int first, int last) { runs.add(raw_, v, first, last); });
  if (samples.rays == 0) return mean_of(cell, nearest(cell, silhouette));
  samples.log_odds = sum_readings(runs.all(), query_for(cell, silhouette));
  return mean_of(cell, samples);
}

FixedSteps FootprintEvidence::of_seen_cell(const CubeInView& cell) const {
  const Silhouette silhouette(view_, cell);
  std::int32_t seen = 0;
  Samples samples = sample(cell, silhouette, [&](int v, int first, int last) {
    const std::uint16_t* row = raw_.row(v).data();
    for (int u = first; u <= last; ++u) seen += row[u] != 0 ? 1 : 0;
  });
  if (samples.rays == 0) return mean_of(cell, nearest(cell, silhouette));
  samples.log_odds = seen * table_.free();
  return mean_of(cell, samples);
}

FixedSteps FootprintEvidence::mean_of(const CubeInView& cell, const Samples& samples) const {
  const float mean = static_cast<float>(samples.log_odds) / static_cast<float>(samples.rays);
  return static_cast<FixedSteps>(view_.observations(cell.p_world, cell.p_camera[2]) * mean *
                                 steps_per_one_);
}

FixedSteps FootprintEvidence::counted(const CubeInView& cell) const {
  PixelRect rect{0, 0, view_.width() - 1, view_.height() - 1};
  if (cell.z_near() > 0.1F * view_.voxel_m()) {
    const Footprint f = view_.footprint(cell);
    if (!view_.meets_image(f)) return 0;
    rect = view_.pixels(f);
  }
  const int stride = stride_of(static_cast<float>(rect.v1 - rect.v0), kRowsNear);
  const Silhouette silhouette(view_, cell);
  const float z = cell.p_camera[2];
  RunList runs;
  for (int v = rect.v0 + (rect.v1 - rect.v0) % stride / 2; v <= rect.v1; v += stride) {
    const Silhouette::Run run =
        silhouette.run(v, static_cast<float>(rect.u0), static_cast<float>(rect.u1));
    if (run.first <= run.last) runs.add(raw_, v, run.first, run.last);
  }
  const auto sum = static_cast<float>(sum_readings(runs.all(), query_for(cell, silhouette)));
  return static_cast<FixedSteps>(sum * static_cast<float>(stride) * z * z * weight_per_z2_ *
                                 steps_per_one_);
}

FootprintEvidence::Samples FootprintEvidence::nearest(const CubeInView& cell,
                                                      const Silhouette& silhouette) const {
  const auto [x, y] = view_.project(cell.p_camera);
  const int u = static_cast<int>(std::floor(x + 0.5F)), v = static_cast<int>(std::floor(y + 0.5F));
  if (u < 0 || v < 0 || u >= view_.width() || v >= view_.height()) return {0, 1};
  RunList runs;
  runs.add(raw_, v, u, u);
  return {sum_readings(runs.all(), query_for(cell, silhouette)), 1};
}

ReadingQuery FootprintEvidence::query_for(const CubeInView& cell,
                                          const Silhouette& silhouette) const {
  ReadingQuery query = query_;
  query.z = cell.p_camera[2];
  silhouette.describe(view_, query);
  return query;
}

}  // namespace swiftlet
