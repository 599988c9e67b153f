// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <utility>

#include "swiftlet/base/progress.hpp"
#include "swiftlet/eval/bench/bench_workload.hpp"
#include "swiftlet/eval/score/score_job.hpp"
#include "swiftlet/eval/truth/leave_out.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::eval {
namespace {

constexpr int kStride_px = 4;

ScoreValue value_of_share(const char* name, double value, bool higher_is_better, std::size_t of) {
  return {name, value, Unit::kShare, higher_is_better, of};
}

}  // namespace

Expected<ScoreReport> score_recording(const ScoreJob& job) {
  auto source = open_source(job.source);
  if (!source) return forward_error(std::move(source));
  auto scored_maps = make_scored_maps(job);
  if (!scored_maps) return forward_error(std::move(scored_maps));
  ScoreReport report{.source = job.source, .voxel_m = job.config.map.voxel_m, .maps = {}};
  report.intrinsics = text_of((*source)->info().intrinsics);
  std::vector<SightLine> left_out;
  std::optional<Stamp> first;
  const ProgressTeller shown(job.progress, (*source)->info().frame_count);
  for (;;) {
    auto frame = (*source)->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    if (is_left_out(report.frames++)) {
      append_readings(**frame, job.config.depth, kStride_px, left_out);
    } else {
      for (ScoredMap& scored : *scored_maps) scored.map->fuse(**frame);
    }
    if (!first) first = (*frame)->stamp;
    report.flight_s = seconds((*frame)->stamp - *first);
    shown.update(images_seen((*source)->tally()));
  }
  if (left_out.empty()) {
    return fail(ErrorCode::kCorruptInput, job.source, "there is no reading to predict",
                "every fifth frame is left out: give a recording of five frames or more");
  }
  for (const ScoredMap& scored : *scored_maps) report.maps.push_back(scored.name);
  for (std::size_t i = 0; i < scored_maps->size(); ++i) {
    Claims claims(box_around(left_out, report.voxel_m), Occupancy::kUnknown);
    (*scored_maps)[i].map->read_claims(claims);
    const Consistency c = consistency_of(claims, left_out, report.voxel_m);
    add_value(report, i, "leave_out",
              value_of_share("left-out readings that end within 1 voxel of an occupied one",
                             c.met_share(), true, c.points));
    add_value(report, i, "leave_out",
              value_of_share("left-out rays blocked more than 2 voxels before", c.blocked_share(),
                             false, c.points));
  }
  return report;
}

}  // namespace swiftlet::eval
